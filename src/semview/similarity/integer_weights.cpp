// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/integer_weights.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "semview/geometry/angle.hpp"

namespace semview::similarity {
namespace {

std::vector<std::int16_t> weights_of_band(const WeightMatrix& weights,
                                          std::size_t band,
                                          std::int32_t scale,
                                          const ClassTable& observed,
                                          const ClassTable& map) {
  const auto position = [](std::span<const std::string> names, std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  const auto map_classes = static_cast<std::size_t>(map.size()) + 1;
  std::vector<std::size_t> column_of(map_classes, position(weights.map_names(), kNoneColumn));
  for (std::size_t j = 1; j < map_classes; ++j) {
    column_of[j] = position(weights.map_names(), map.names()[j - 1]);
  }
  std::vector<std::int16_t> integers(256 * map_classes, 0);
  for (std::size_t i = 1; i <= observed.names().size(); ++i) {
    const std::size_t row = position(weights.observed_names(), observed.names()[i - 1]);
    for (std::size_t j = 0; j < map_classes; ++j) {
      integers[j * 256 + i] =
          static_cast<std::int16_t>(std::lround(weights.weight(band, row, column_of[j]) * scale));
    }
  }
  return integers;
}

std::optional<std::size_t> band_at(const WeightMatrix& weights, double elevation_deg) {
  for (std::size_t b = 0; b < weights.bands().size(); ++b) {
    const WeightMatrix::Band& band = weights.bands()[b];
    if (elevation_deg >= band.elevation_min_deg && elevation_deg < band.elevation_max_deg) return b;
  }
  return {};
}

}  // namespace

Result<IntegerWeights> integer_weights(const WeightMatrix& weights,
                                       std::int32_t scale,
                                       const ClassTable& observed,
                                       const ClassTable& map,
                                       const PanoramaCamera& camera) {
  IntegerWeights integers;
  for (std::size_t b = 0; b < weights.bands().size(); ++b) {
    integers.of_band.push_back(weights_of_band(weights, b, scale, observed, map));
  }
  for (int r = 0; r < camera.rows; ++r) {
    const double elevation_deg = deg_from_rad(camera.elevation_rad(r));
    const std::optional<std::size_t> band = band_at(weights, elevation_deg);
    if (!band) {
      return fail(ErrorCode::kFailedPrecondition,
                  fmt::format("weights: no band for elevation {:g} degrees of the view profile",
                              elevation_deg));
    }
    integers.of_row.push_back(integers.of_band[*band].data());
  }
  return integers;
}

}  // namespace semview::similarity
