// SPDX-License-Identifier: Apache-2.0
#include "client/lib/remote_heat_map.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

#include "semview/protocol/view_wire.hpp"
#include "semview/v1/scores.pb.h"

namespace semview::client {

void to_wire(const HeatMapQuestion& question, v1::HeatmapRequest* wire) {
  if (question.region) to_wire(*question.region, wire->mutable_region());
  wire->set_headings(static_cast<std::uint32_t>(question.headings));
  if (!question.posterior) return;
  v1::Weighting* const weighting = wire->mutable_posterior();
  if (question.posterior->transform == observation::WeightTransform::kPower) {
    weighting->set_power(question.posterior->power);
  } else {
    weighting->set_kappa(question.posterior->kappa);
  }
}

Result<HeatMapAnswer> from_wire(const v1::HeatmapReply& wire, const HeatMapQuestion& question) {
  const std::uint64_t pixels = std::uint64_t{wire.rows()} * wire.columns();
  const std::uint64_t probabilities = question.posterior ? pixels : 0;
  if (pixels == 0 || pixels > static_cast<std::uint64_t>(similarity::kMaxHeatMapPixels) ||
      static_cast<std::uint64_t>(wire.similarity_size()) != pixels ||
      wire.best_headings().size() != pixels ||
      static_cast<std::uint64_t>(wire.probability_size()) != probabilities) {
    return fail(ErrorCode::kDataLoss,
                fmt::format("heat map: {} similarities, {} headings and {} probabilities; expected "
                            "{} × {}{}",
                            wire.similarity_size(),
                            wire.best_headings().size(),
                            wire.probability_size(),
                            wire.rows(),
                            wire.columns(),
                            question.posterior ? " of each" : " and no probabilities"));
  }
  const auto rows = static_cast<int>(wire.rows());
  const auto columns = static_cast<int>(wire.columns());
  HeatMapAnswer answer;
  answer.heat.origin = {wire.origin_ix(), wire.origin_iy()};
  answer.heat.origins = protocol::from_wire(wire.origins());
  answer.heat.similarity = Image<float>(rows, columns);
  std::ranges::copy(wire.similarity(), answer.heat.similarity.pixels().begin());
  answer.heat.best_heading = Image<std::uint8_t>(rows, columns);
  std::ranges::transform(wire.best_headings(),
                         answer.heat.best_heading.pixels().begin(),
                         [](char heading) { return static_cast<std::uint8_t>(heading); });
  if (question.posterior) {
    answer.probability = Image<float>(rows, columns);
    std::ranges::copy(wire.probability(), answer.probability.pixels().begin());
  }
  return answer;
}

}  // namespace semview::client
