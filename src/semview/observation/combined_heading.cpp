// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/combined_heading.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <fmt/format.h>

#include "semview/core/check.hpp"

namespace semview::observation {
namespace {

constexpr int kHeadings = PoseGrid::kHeadings;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

double log_prior(double difference_rad, const CombinedHeadingConfig& config) {
  const double off = difference_rad / config.sigma_rad;
  return std::log((1.0 - config.lost_probability) * std::exp(-0.5 * off * off) +
                  config.lost_probability);
}

/// Where a parabola through three neighbours has its top, in steps from the middle one.
double top_of_parabola(double before, double middle, double after) {
  const double bend = before - 2.0 * middle + after;
  if (!std::isfinite(bend) || !(bend < 0.0)) return 0.0;
  return 0.5 * (before - after) / bend;
}

}  // namespace

Status validate(const CombinedHeadingConfig& config) {
  if (!(config.sigma_rad > 0.0 && config.sigma_rad <= kPi)) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("the carried heading's sigma is {:.2f} deg: expected above 0, at "
                                  "most 180",
                                  deg_from_rad(config.sigma_rad)),
                      "sigma_rad"});
  }
  if (!(config.lost_probability > 0.0 && config.lost_probability <= 1.0)) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("the probability of a lost heading is {}: expected above 0, at "
                                  "most 1",
                                  config.lost_probability),
                      "lost_probability"});
  }
  return {};
}

HeadingChoice combine_heading(std::span<const std::int32_t> curve,
                              const ScoreBatch& batch,
                              std::optional<double> carried_yaw_rad,
                              const SimilarityWeightingConfig& weighting,
                              const CombinedHeadingConfig& config) {
  SEMVIEW_CHECK(curve.size() == static_cast<std::size_t>(kHeadings));
  std::array<double, kHeadings> log_weights{};
  int best = -1;
  double best_off_rad = 0.0;
  for (int k = 0; k < kHeadings; ++k) {
    const auto i = static_cast<std::size_t>(k);
    double& value = log_weights[i];
    value = curve[i] == kNoView ? kNothing : log_weight(weighting, batch.similarity(curve[i]));
    double off_rad = 0.0;
    if (carried_yaw_rad) {
      off_rad = std::abs(wrap_angle(PoseGrid::heading_yaw_rad(k) - *carried_yaw_rad));
      value += log_prior(off_rad, config);
    }
    if (!std::isfinite(value)) continue;
    const bool better =
        best < 0 || value > log_weights[static_cast<std::size_t>(best)] ||
        (value == log_weights[static_cast<std::size_t>(best)] && off_rad < best_off_rad);
    if (!better) continue;
    best = k;
    best_off_rad = off_rad;
  }
  if (best < 0) return {kNothing, -std::numeric_limits<double>::infinity()};
  const auto at = [&](int k) {
    return log_weights[static_cast<std::size_t>((k + kHeadings) % kHeadings)];
  };
  const double step = top_of_parabola(at(best - 1), at(best), at(best + 1));
  return {wrap_angle(PoseGrid::heading_yaw_rad(best) + step * kTwoPi / kHeadings), at(best)};
}

}  // namespace semview::observation
