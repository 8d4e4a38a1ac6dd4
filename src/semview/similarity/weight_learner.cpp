// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/weight_learner.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "semview/core/check.hpp"

namespace semview::similarity {
namespace {

std::size_t to_size(int value) { return static_cast<std::size_t>(value); }

}  // namespace

Status validate(const WeightLearnerConfig& config) {
  if (config.bands < 1 || to_size(config.bands) > kMaxElevationBands) {
    return fail(
        Error{ErrorCode::kInvalidArgument,
              fmt::format("{} elevation bands: expected 1 to {}", config.bands, kMaxElevationBands),
              "bands"});
  }
  if (!(config.prior_pixels > 0.0 && std::isfinite(config.prior_pixels))) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("a prior of {} pixels: expected above 0", config.prior_pixels),
                      "prior_pixels"});
  }
  if (!(config.largest_weight > 0.0 && std::isfinite(config.largest_weight))) {
    return fail(
        Error{ErrorCode::kInvalidArgument,
              fmt::format("a largest weight of {}: expected above 0", config.largest_weight),
              "largest_weight"});
  }
  return {};
}

WeightLearner::WeightLearner(const WeightLearnerConfig& config,
                             ClassTable observed,
                             ClassTable map,
                             const PanoramaCamera& camera)
    : config_(config), observed_(std::move(observed)), map_(std::move(map)), camera_(camera) {
  counts_.assign(to_size(config_.bands) * to_size(observed_.size()) * to_size(map_.size() + 1),
                 0.0);
}

double& WeightLearner::count(int band, ClassId observed, ClassId seen) {
  return counts_[(to_size(band) * to_size(observed_.size()) + observed - 1U) *
                     to_size(map_.size() + 1) +
                 seen];
}

void WeightLearner::add(const LabelImage& observed, const LabelImage& seen) {
  SEMVIEW_CHECK(observed.rows() == camera_.rows && observed.columns() == camera_.columns);
  SEMVIEW_CHECK(seen.rows() == camera_.rows && seen.columns() == camera_.columns);
  for (int row = 0; row < camera_.rows; ++row) {
    // Row 0 looks highest and bands rise.
    const int band =
        std::min(config_.bands - 1, (camera_.rows - 1 - row) * config_.bands / camera_.rows);
    for (int column = 0; column < camera_.columns; ++column) {
      const ClassId label = observed.at(row, column);
      if (label == kNoHit || label > observed_.size()) continue;
      ++count(band, label, seen.at(row, column));
      ++pixels_;
    }
  }
}

Result<WeightMatrix> WeightLearner::matrix() const {
  if (pixels_ == 0) {
    return fail(ErrorCode::kFailedPrecondition, "no observed pixels to learn weights from");
  }
  const std::size_t rows = to_size(observed_.size());
  const std::size_t columns = to_size(map_.size() + 1);
  std::vector<std::string> map_names(map_.names().begin(), map_.names().end());
  map_names.emplace_back(kNoneColumn);
  const double low_deg = deg_from_rad(camera_.elevation_min_rad);
  const double step_deg =
      (deg_from_rad(camera_.elevation_max_rad) - low_deg) / static_cast<double>(config_.bands);
  std::vector<WeightMatrix::Band> bands;
  for (std::size_t b = 0; b < to_size(config_.bands); ++b) {
    const double* counts = counts_.data() + b * rows * columns;
    std::vector<double> of_observed(rows, 0.0);
    std::vector<double> of_map(columns, 0.0);
    double all = 0.0;
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t j = 0; j < columns; ++j) {
        of_observed[i] += counts[i * columns + j];
        of_map[j] += counts[i * columns + j];
        all += counts[i * columns + j];
      }
    }
    WeightMatrix::Band band;
    band.elevation_min_deg = b == 0 ? -90.0 : low_deg + step_deg * static_cast<double>(b);
    band.elevation_max_deg =
        b + 1 == to_size(config_.bands) ? 90.0 : low_deg + step_deg * static_cast<double>(b + 1);
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t column = 0; column < columns; ++column) {
        // The file has `none` last, ids have it first.
        const std::size_t j = (column + 1) % columns;
        double weight = 0.0;
        if (of_observed[i] > 0.0 && of_map[j] > 0.0) {
          // The prior spreads as the observed classes do, so that it favours nobody.
          const double share = of_observed[i] / all;
          const double likelihood = (counts[i * columns + j] + config_.prior_pixels * share) /
                                    (of_map[j] + config_.prior_pixels);
          weight = std::log(likelihood / share);
        }
        band.weights.push_back(std::clamp(weight, -config_.largest_weight, config_.largest_weight));
      }
    }
    bands.push_back(std::move(band));
  }
  return WeightMatrix::build(
      {observed_.names().begin(), observed_.names().end()}, std::move(map_names), std::move(bands));
}

}  // namespace semview::similarity
