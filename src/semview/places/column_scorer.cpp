// SPDX-License-Identifier: Apache-2.0
#include "semview/places/column_scorer.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "semview/geometry/angle.hpp"

namespace semview::places {
namespace {

constexpr std::size_t kLabels = 256;

std::size_t position(std::span<const std::string> names, std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

/// Weights [observed label][map label] of a band; what is not scored has zeros.
std::vector<float> table_of(const similarity::WeightMatrix& weights,
                            std::size_t band,
                            const ClassTable& observed,
                            const ClassTable& map) {
  std::vector<float> table(kLabels * kLabels, 0.0F);
  for (std::size_t i = 0; i < observed.names().size(); ++i) {
    const std::size_t row = position(weights.observed_names(), observed.names()[i]);
    for (std::size_t j = 0; j <= map.names().size(); ++j) {
      const std::string_view name =
          j == 0 ? similarity::kNoneColumn : std::string_view(map.names()[j - 1]);
      table[(i + 1) * kLabels + j] =
          static_cast<float>(weights.weight(band, row, position(weights.map_names(), name)));
    }
  }
  return table;
}

Result<std::size_t> band_at(const similarity::WeightMatrix& weights, double elevation_deg) {
  for (std::size_t b = 0; b < weights.bands().size(); ++b) {
    const similarity::WeightMatrix::Band& band = weights.bands()[b];
    if (elevation_deg >= band.elevation_min_deg && elevation_deg < band.elevation_max_deg) return b;
  }
  return fail(ErrorCode::kFailedPrecondition,
              fmt::format("weights: no band covers the elevation {:g} deg", elevation_deg));
}

}  // namespace

Status validate(const ColumnScorerConfig& config) {
  if (!(config.stray_probability > 0.0 && config.stray_probability < 1.0)) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("a column strays with probability {}: expected above 0, below 1",
                                  config.stray_probability),
                      "stray_probability"});
  }
  if (!(config.pixels_per_column > 0.0 && std::isfinite(config.pixels_per_column))) {
    return fail(Error{
        ErrorCode::kInvalidArgument,
        fmt::format("{} independent pixels a column: expected above 0", config.pixels_per_column),
        "pixels_per_column"});
  }
  return {};
}

Result<ColumnScorer> ColumnScorer::build(const Observation& observation,
                                         const similarity::WeightMatrix& weights,
                                         const ClassTable& map_classes,
                                         const PanoramaCamera& camera,
                                         const ColumnScorerConfig& config) {
  SEMVIEW_TRY_STATUS(validate(config));
  SEMVIEW_TRY_STATUS(weights.check(observation.classes, map_classes));
  if (observation.labels.rows() != camera.rows || observation.labels.columns() != camera.columns) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("observation of {} x {} pixels, expected {} x {}",
                            observation.labels.columns(),
                            observation.labels.rows(),
                            camera.columns,
                            camera.rows));
  }
  ColumnScorer scorer;
  scorer.config_ = config;
  scorer.observed_ = observation.labels;
  scorer.pixels_of_column_.assign(static_cast<std::size_t>(camera.columns), 0.0);
  for (int row = 0; row < camera.rows; ++row) {
    SEMVIEW_TRY(const std::size_t band, band_at(weights, deg_from_rad(camera.elevation_rad(row))));
    scorer.band_of_row_.push_back(band);
    for (int column = 0; column < camera.columns; ++column) {
      ClassId& label = scorer.observed_.at(row, column);
      if (label > observation.classes.size()) label = kNoHit;  // unknown: its weights are zeros
      if (label != kNoHit) scorer.pixels_of_column_[static_cast<std::size_t>(column)] += 1.0;
    }
  }
  for (const double pixels : scorer.pixels_of_column_) scorer.pixels_ += pixels;
  if (scorer.pixels_ == 0.0) {
    return fail(ErrorCode::kInvalidArgument,
                "observation: every pixel is unknown, nothing to compare");
  }
  for (std::size_t b = 0; b < weights.bands().size(); ++b) {
    scorer.band_weights_.push_back(table_of(weights, b, observation.classes, map_classes));
  }
  return scorer;
}

double ColumnScorer::score(const LabelImage& view, int turn) const {
  const int columns = observed_.columns();
  // Turning left moves what the view shows to the right in it.
  const int shift = ((turn % columns) + columns) % columns;
  std::vector<float> sums(static_cast<std::size_t>(columns), 0.0F);
  for (int row = 0; row < observed_.rows(); ++row) {
    const float* weights = band_weights_[band_of_row_[static_cast<std::size_t>(row)]].data();
    const ClassId* observed = observed_.row(row).data();
    const ClassId* seen = view.row(row).data();
    for (int c = 0; c < shift; ++c) {
      sums[static_cast<std::size_t>(c)] +=
          weights[observed[c] * kLabels + seen[c - shift + columns]];
    }
    for (int c = shift; c < columns; ++c) {
      sums[static_cast<std::size_t>(c)] += weights[observed[c] * kLabels + seen[c - shift]];
    }
  }
  const double stray = config_.stray_probability;
  const double worth = config_.pixels_per_column;
  double total = 0.0;
  for (std::size_t c = 0; c < sums.size(); ++c) {
    if (pixels_of_column_[c] == 0.0) continue;
    const double mean = static_cast<double>(sums[c]) / pixels_of_column_[c];
    total += pixels_of_column_[c] * std::log((1.0 - stray) * std::exp(worth * mean) + stray);
  }
  return total / (worth * pixels_);
}

}  // namespace semview::places
