// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "semview/geometry/pose_grid.hpp"

namespace semview {
namespace {

GridKey any_key() {
  return {{*rc::gen::inRange(-10'000'000, 10'000'000), *rc::gen::inRange(-10'000'000, 10'000'000)},
          *rc::gen::inRange(0, PoseGrid::kHeadings)};
}

double any_between(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1'000'000'000) * 1.0e-9;
}

RC_GTEST_PROP(PoseGridProperty, TheCentreOfAKeyHasThatKey, ()) {
  const GridKey key = any_key();
  RC_ASSERT(PoseGrid::key(PoseGrid::center(key)) == key);
}

RC_GTEST_PROP(PoseGridProperty, EveryHeadingComesBackFromItsYaw, ()) {
  const int heading = *rc::gen::inRange(0, PoseGrid::kHeadings);
  RC_ASSERT(PoseGrid::heading(PoseGrid::heading_yaw_rad(heading)) == heading);
}

RC_GTEST_PROP(PoseGridProperty, ATurnMoreOrLessIsTheSameHeading, ()) {
  // Away from ties, where the last bit of yaw + 2π decides.
  const double yaw =
      PoseGrid::heading_yaw_rad(*rc::gen::inRange(0, 120)) + any_between(-0.99, 0.99) * kPi / 120.0;
  const int turns = *rc::gen::inRange(-5, 6);
  RC_ASSERT(PoseGrid::heading(yaw) == PoseGrid::heading(yaw + turns * kTwoPi));
}

RC_GTEST_PROP(PoseGridProperty, TheHeadingIsTheNearestOne, ()) {
  const double yaw = any_between(-kPi, kPi);
  const double off = wrap_angle(yaw - PoseGrid::heading_yaw_rad(PoseGrid::heading(yaw)));
  RC_ASSERT(std::abs(off) <= kPi / 120.0 + 1.0e-12);
}

RC_GTEST_PROP(PoseGridProperty, APointLiesInsideItsCell, ()) {
  const double x = any_between(-500.0, 500.0);
  const double y = any_between(-500.0, 500.0);
  const std::optional<CellIndex> cell = PoseGrid::cell(x, y);
  RC_ASSERT(cell.has_value());
  const Pose2 center = PoseGrid::center(*cell);
  RC_ASSERT(std::abs(x - center.x_m) <= 0.05 + 1.0e-9);
  RC_ASSERT(std::abs(y - center.y_m) <= 0.05 + 1.0e-9);
}

}  // namespace
}  // namespace semview
