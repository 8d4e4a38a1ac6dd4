// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/position_noise_model.hpp"

#include <cmath>

#include <fmt/format.h>

namespace semview::localization {
namespace {

Status check_sigma(const char* field, double value) {
  if (std::isfinite(value) && value >= 0.0) return {};
  return fail(Error{ErrorCode::kInvalidArgument,
                    fmt::format("{} is {}: expected a number >= 0", field, value),
                    field});
}

}  // namespace

Status validate(const PositionNoiseConfig& config) {
  SEMVIEW_TRY_STATUS(check_sigma("sigma_m", config.sigma_m));
  SEMVIEW_TRY_STATUS(check_sigma("sigma_per_m", config.sigma_per_m));
  return check_sigma("heading_sigma_rad", config.heading_sigma_rad);
}

Pose2 PositionNoiseModel::sample(const Pose2& map_from_before,
                                 const Pose2& before_from_after,
                                 Rng& rng) const {
  Pose2 map_from_after = map_from_before * before_from_after;
  const double sigma_m = config_.sigma_m + config_.sigma_per_m * std::hypot(before_from_after.x_m,
                                                                            before_from_after.y_m);
  map_from_after.x_m = rng.normal(map_from_after.x_m, sigma_m);
  map_from_after.y_m = rng.normal(map_from_after.y_m, sigma_m);
  map_from_after.yaw_rad =
      wrap_angle(rng.normal(map_from_after.yaw_rad, config_.heading_sigma_rad));
  return map_from_after;
}

}  // namespace semview::localization
