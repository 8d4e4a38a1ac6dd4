// SPDX-License-Identifier: Apache-2.0
#include "map_weights.hpp"

#include <utility>

#include <fmt/format.h>

#include "semview/core/log.hpp"
#include "weights_option.hpp"

namespace semview::cli {

Result<ChosenWeights> choose_weights(const std::string& weights,
                                     const std::string& map_name,
                                     const std::string& shipped_csv,
                                     const ClassTable& observed,
                                     const ClassTable& map) {
  if (!weights.empty()) {
    SEMVIEW_TRY(similarity::WeightMatrix matrix, read_weights(weights, observed, map));
    Status fits = matrix.check(observed, map);
    if (!fits) return with_context(std::move(fits), weights);
    return ChosenWeights{std::move(matrix), weights};
  }
  const std::string shipped_name = map_name + ": weights.csv";
  std::string why_not = "the map has no weights.csv";
  if (!shipped_csv.empty()) {
    SEMVIEW_TRY(similarity::WeightMatrix matrix,
                similarity::parse_weight_matrix(shipped_csv, shipped_name));
    const Status fits = matrix.check(observed, map);
    if (fits) return ChosenWeights{std::move(matrix), shipped_name};
    why_not = fmt::format("{}: {}", shipped_name, fits.error().message);
  }
  similarity::WeightMatrix identity = similarity::WeightMatrix::identity(map);
  const Status same = identity.check(observed, map);
  if (same) {
    log_warning(fmt::format("weights: identity (only equal names score), for {}", why_not));
    return ChosenWeights{std::move(identity), std::string(kIdentityWeights)};
  }
  return fail(Error{
      ErrorCode::kInvalidArgument,
      fmt::format("--weights is needed: {}, and not every class of the log is the map's", why_not),
      "--weights",
      same.error().hint});
}

}  // namespace semview::cli
