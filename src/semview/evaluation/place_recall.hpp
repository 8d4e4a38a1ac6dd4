// SPDX-License-Identifier: Apache-2.0
/// How often a single picture was put where it was taken.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "semview/geometry/pose2.hpp"

namespace semview::evaluation {

/// As in the literature on single images and floor plans.
inline constexpr std::array<double, 4> kRecallDistances_m = {0.1, 0.25, 0.5, 1.0};
/// The heading must be right within this, too; 180: it need not.
inline constexpr std::array<double, 4> kRecallGates_deg = {180.0, 30.0, 10.0, 5.0};

/// The answer for one picture beside the truth.
struct PlaceError {
  double position_m = 0.0;   ///< +∞ if there was no answer
  double heading_rad = 0.0;  ///< >= 0
  double probability = 0.0;  ///< that the answer claimed for itself
};

PlaceError place_error(const Pose2& answer, const Pose2& truth, double probability);

struct PlaceRecall {
  std::size_t pictures = 0;
  /// [gate][distance]: the share of the pictures within both.
  std::array<std::array<double, 4>, 4> recall{};
  double median_m = 0.0;  ///< of an even number of pictures the upper of the middle two
  double median_rad = 0.0;
  /// Within 0.5 m and 15°: the robot knows where it is.
  double located = 0.0;
  double mean_probability = 0.0;  ///< claimed; near `located` if the claims are honest
};

PlaceRecall recall_of(std::span<const PlaceError> errors);

}  // namespace semview::evaluation
