// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/weight_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace semview::similarity {
namespace {

/// The first name that is empty or was there before.
std::optional<std::string> bad_name(std::vector<std::string> names) {
  std::ranges::sort(names);
  if (!names.empty() && names.front().empty()) return std::string();
  const auto twice = std::ranges::adjacent_find(names);
  if (twice == names.end()) return {};
  return *twice;
}

Status check_names(const std::vector<std::string>& names, std::string_view what) {
  if (names.empty()) {
    return fail(ErrorCode::kInvalidArgument, fmt::format("weights: no {}", what));
  }
  if (const std::optional<std::string> bad = bad_name(names)) {
    return fail(ErrorCode::kInvalidArgument,
                bad->empty() ? fmt::format("weights: empty name among the {}", what)
                             : fmt::format("weights: {} named twice among the {}", *bad, what));
  }
  return {};
}

Status check_bands(const std::vector<WeightMatrix::Band>& bands, std::size_t size) {
  if (bands.empty() || bands.size() > kMaxElevationBands) {
    return fail(
        ErrorCode::kInvalidArgument,
        fmt::format(
            "weights: {} elevation bands, expected 1 to {}", bands.size(), kMaxElevationBands));
  }
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const double low = bands[b].elevation_min_deg;
    const double high = bands[b].elevation_max_deg;
    if (!(low >= -90.0 && high <= 90.0 && low < high)) {
      return fail(
          ErrorCode::kInvalidArgument,
          fmt::format(
              "weights: band {:g} to {:g} degrees must increase within -90 to 90", low, high));
    }
    if (b > 0 && bands[b - 1].elevation_max_deg > low) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("weights: bands {:g} to {:g} and {:g} to {:g} degrees overlap",
                              bands[b - 1].elevation_min_deg,
                              bands[b - 1].elevation_max_deg,
                              low,
                              high));
    }
    if (bands[b].weights.size() != size) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("weights: band {:g} to {:g} degrees has {} weights, expected {}",
                              low,
                              high,
                              bands[b].weights.size(),
                              size));
    }
    if (!std::ranges::all_of(bands[b].weights, [](double w) { return std::isfinite(w); })) {
      return fail(ErrorCode::kInvalidArgument, "weights: a weight is not finite");
    }
  }
  return {};
}

std::string list_missing(std::span<const std::string> wanted,
                         std::span<const std::string> present) {
  std::string list;
  for (const std::string& name : wanted) {
    if (std::ranges::find(present, name) != present.end()) continue;
    list += list.empty() ? "" : ", ";
    list += name;
  }
  return list;
}

}  // namespace

Result<WeightMatrix> WeightMatrix::build(std::vector<std::string> observed_names,
                                         std::vector<std::string> map_names,
                                         std::vector<Band> bands) {
  SEMVIEW_TRY_STATUS(check_names(observed_names, "observed classes"));
  SEMVIEW_TRY_STATUS(check_names(map_names, "map classes"));
  if (observed_names.size() > kMaxWeightRows || map_names.size() > kMaxClasses + 1) {
    return fail(ErrorCode::kResourceExhausted,
                fmt::format("weights: {} rows and {} columns, expected at most {} and {}",
                            observed_names.size(),
                            map_names.size(),
                            kMaxWeightRows,
                            kMaxClasses + 1));
  }
  std::ranges::sort(bands, {}, &Band::elevation_min_deg);
  SEMVIEW_TRY_STATUS(check_bands(bands, observed_names.size() * map_names.size()));
  WeightMatrix matrix;
  matrix.observed_names_ = std::move(observed_names);
  matrix.map_names_ = std::move(map_names);
  matrix.bands_ = std::move(bands);
  return matrix;
}

WeightMatrix WeightMatrix::identity(const ClassTable& observed, const ClassTable& map) {
  WeightMatrix matrix;
  matrix.observed_names_.assign(observed.names().begin(), observed.names().end());
  matrix.map_names_.assign(map.names().begin(), map.names().end());
  matrix.map_names_.emplace_back(kNoneColumn);
  const std::size_t columns = matrix.map_names_.size();
  Band band;
  band.weights.assign(matrix.observed_names_.size() * columns, 0.0);
  for (std::size_t i = 0; i < matrix.observed_names_.size(); ++i) {
    const std::optional<ClassId> same = map.id(matrix.observed_names_[i]);
    if (same) band.weights[i * columns + *same - 1U] = 1.0;
  }
  matrix.bands_.push_back(std::move(band));
  return matrix;
}

double WeightMatrix::max_abs_weight() const {
  double largest = 0.0;
  for (const Band& band : bands_) {
    for (const double weight : band.weights) largest = std::max(largest, std::abs(weight));
  }
  return largest;
}

Status WeightMatrix::check(const ClassTable& observed, const ClassTable& map) const {
  std::vector<std::string> columns(map.names().begin(), map.names().end());
  columns.emplace_back(kNoneColumn);
  const std::string rows_missing = list_missing(observed.names(), observed_names_);
  const std::string columns_missing = list_missing(columns, map_names_);
  if (rows_missing.empty() && columns_missing.empty()) return {};
  std::string message = "weights:";
  if (!rows_missing.empty()) message += " no row for observed class " + rows_missing;
  if (!columns_missing.empty()) {
    message += rows_missing.empty() ? "" : ";";
    message += " no column for map class " + columns_missing;
  }
  return fail(Error{
      ErrorCode::kFailedPrecondition,
      std::move(message),
      "weights",
      "`semview weights init MAP --vocabulary V -o w.csv` writes a row for every class of V (give "
      "the run log, for its own) and of the map, and every column"});
}

}  // namespace semview::similarity
