// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/odometry_motion_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace semview::localization {
namespace {

// Below this a step has no direction worth the name (AMCL's value).
constexpr double kShortestStep_m = 0.01;

double square(double value) { return value * value; }

// How far a rotation is from none or from a half turn, whichever is nearer.
double rotation_for_noise(double rotation_rad) {
  const double forwards = std::abs(wrap_angle(rotation_rad));
  return std::min(forwards, kPi - forwards);
}

}  // namespace

Status validate(const OdometryMotionConfig& config) {
  for (const auto& [field, value] : {std::pair("alpha1", config.alpha1),
                                     std::pair("alpha2", config.alpha2),
                                     std::pair("alpha3", config.alpha3),
                                     std::pair("alpha4", config.alpha4)}) {
    if (std::isfinite(value) && value >= 0.0) continue;
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("{} is {}: expected a number >= 0", field, value),
                      field});
  }
  return {};
}

Pose2 OdometryMotionModel::sample(const Pose2& map_from_before,
                                  const Pose2& before_from_after,
                                  Rng& rng) const {
  const double way_m = std::hypot(before_from_after.x_m, before_from_after.y_m);
  const double first_rad =
      way_m < kShortestStep_m ? 0.0 : std::atan2(before_from_after.y_m, before_from_after.x_m);
  const double second_rad = wrap_angle(before_from_after.yaw_rad - first_rad);

  const double first2 = square(rotation_for_noise(first_rad));
  const double second2 = square(rotation_for_noise(second_rad));
  const double way2 = square(way_m);
  const double first_noise =
      rng.normal(0.0, std::sqrt(config_.alpha1 * first2 + config_.alpha2 * way2));
  const double way_noise =
      rng.normal(0.0, std::sqrt(config_.alpha3 * way2 + config_.alpha4 * (first2 + second2)));
  const double second_noise =
      rng.normal(0.0, std::sqrt(config_.alpha1 * second2 + config_.alpha2 * way2));

  const double course_rad = map_from_before.yaw_rad + first_rad + first_noise;
  return {map_from_before.x_m + (way_m + way_noise) * std::cos(course_rad),
          map_from_before.y_m + (way_m + way_noise) * std::sin(course_rad),
          wrap_angle(course_rad + second_rad + second_noise)};
}

}  // namespace semview::localization
