// SPDX-License-Identifier: Apache-2.0
#include "semview/evaluation/place_recall.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "semview/geometry/angle.hpp"

namespace semview::evaluation {
namespace {

constexpr double kLocatedWithin_m = 0.5;
constexpr double kLocatedWithin_deg = 15.0;

template <typename Member>
double median(std::span<const PlaceError> errors, Member member) {
  std::vector<double> values;
  for (const PlaceError& error : errors) values.push_back(error.*member);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double share_within(std::span<const PlaceError> errors, double distance_m, double gate_deg) {
  const auto within = std::ranges::count_if(errors, [&](const PlaceError& error) {
    return error.position_m <= distance_m && error.heading_rad <= rad_from_deg(gate_deg) + 1e-12;
  });
  return static_cast<double>(within) / static_cast<double>(errors.size());
}

}  // namespace

PlaceError place_error(const Pose2& answer, const Pose2& truth, double probability) {
  return {
      distance_m(answer, truth), std::abs(wrap_angle(answer.yaw_rad - truth.yaw_rad)), probability};
}

PlaceRecall recall_of(std::span<const PlaceError> errors) {
  PlaceRecall recall;
  recall.pictures = errors.size();
  if (errors.empty()) return recall;
  for (std::size_t g = 0; g < kRecallGates_deg.size(); ++g) {
    for (std::size_t d = 0; d < kRecallDistances_m.size(); ++d) {
      recall.recall[g][d] = share_within(errors, kRecallDistances_m[d], kRecallGates_deg[g]);
    }
  }
  recall.median_m = median(errors, &PlaceError::position_m);
  recall.median_rad = median(errors, &PlaceError::heading_rad);
  recall.located = share_within(errors, kLocatedWithin_m, kLocatedWithin_deg);
  for (const PlaceError& error : errors) {
    recall.mean_probability += error.probability / static_cast<double>(errors.size());
  }
  return recall;
}

}  // namespace semview::evaluation
