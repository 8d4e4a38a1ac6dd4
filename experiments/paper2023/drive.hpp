// SPDX-License-Identifier: Apache-2.0
/// The robot's ways through a flat.
#pragma once

#include <cstdint>
#include <vector>

#include "flat.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/geometry/pose2.hpp"

namespace semview::paper2023 {

struct DriveConfig {
  double length_m = 10.0;
  double robot_radius_m = 0.22;
  double robot_height_m = 1.1;
  double step_m = 0.20;                  ///< between images
  double turn_rad = rad_from_deg(20.0);  ///< or after this much turning on the spot
};

/// Poses of a drive of about `length_m` from room to room, where nothing is in the way.
std::vector<Pose2> plan_drive(const Flat& flat, const DriveConfig& config, std::uint64_t seed);

/// Poses of a drive that looks all round at three places of every room.
std::vector<Pose2> plan_survey(const Flat& flat, const DriveConfig& config, std::uint64_t seed);

struct OdometryConfig {
  double scale_sigma = 0.02;       ///< of one factor for a whole drive
  double drift_rad_per_m = 0.015;  ///< σ over a metre, growing with its root
  double turn_sigma = 0.03;        ///< share of a turn that is misread
  double slip_m_per_m = 0.02;      ///< σ over a metre, growing with its root
};

/// Poses since the first one as wheels tell them.
std::vector<Pose2> odometry_of(const std::vector<Pose2>& map_from_base,
                               const OdometryConfig& config,
                               std::uint64_t seed);

}  // namespace semview::paper2023
