// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "semview/map/cell_grid.hpp"
#include "semview/simulation/free_space.hpp"
#include "semview/simulation/path_planner.hpp"
#include "semview/simulation/robot_drive.hpp"
#include "simulation/two_rooms.hpp"

namespace semview::simulation {
namespace {

const map::CellGrid& grid() {
  static const map::CellGrid cells = map::build_cell_grid(*two_rooms().columns(), 1.2);
  return cells;
}

TEST(FreeSpaceTest, ClearanceIsTheDistanceToTheNearestWall) {
  const FreeSpace space(grid());
  EXPECT_EQ(space.clearance_m(0.05, 2.0), 0.0);            // in the wall
  EXPECT_NEAR(space.clearance_m(0.15, 2.05), 0.05, 1e-9);  // the first cell beside it
  EXPECT_NEAR(space.clearance_m(0.55, 2.05), 0.45, 1e-9);
  EXPECT_EQ(space.clearance_m(2.05, 1.55), FreeSpace::kHorizon_m);  // nothing within a metre
  EXPECT_EQ(space.clearance_m(100.0, 100.0), 0.0);
}

TEST(PathPlannerTest, TourIsLongEnoughAndKeepsItsClearance) {
  const FreeSpace space(grid());
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng(seed, "path");
    const auto line = plan_tour(space, {.length_m = 15.0}, rng);
    ASSERT_TRUE(line) << line.error().message;
    double length_m = 0.0;
    for (std::size_t k = 1; k < line->size(); ++k) {
      const Point2& a = (*line)[k - 1];
      const Point2& b = (*line)[k];
      const double step_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
      ASSERT_LE(step_m, 0.051);
      length_m += step_m;
      ASSERT_GE(space.clearance_m(b.x_m, b.y_m), 0.1);
    }
    EXPECT_GT(length_m, 12.0);
  }
}

TEST(PathPlannerTest, NoRoomIsAnError) {
  const map::CellGrid narrow(CellIndex{0, 0}, 3, 3, std::vector<std::uint8_t>(9, 15));
  Rng rng(1);
  const auto line = plan_tour(FreeSpace(narrow), {}, rng);
  ASSERT_FALSE(line);
  EXPECT_EQ(line.error().code, ErrorCode::kFailedPrecondition);
}

TEST(RobotDriveTest, StaysNearTheLineWithinItsLimitsAndSmoothly) {
  const FreeSpace space(grid());
  const DriveConfig config;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng(seed, "path");
    const std::vector<Point2> line = plan_tour(space, {.length_m = 20.0}, rng).value();
    const auto poses = drive(line, 15.0, config);
    ASSERT_GT(poses.size(), 500U);
    double way_m = 0.0;
    for (std::size_t k = 1; k < poses.size(); ++k) {
      const Pose2 step = inverse(poses[k - 1].pose) * poses[k].pose;
      way_m += std::hypot(step.x_m, step.y_m);
      ASSERT_LE(std::hypot(step.x_m, step.y_m), config.max_speed_mps * config.tick_s + 1e-9);
      ASSERT_LE(std::abs(step.yaw_rad), config.max_turn_radps * config.tick_s + 1e-9);
      ASSERT_LE(std::abs(step.y_m), 1e-3);  // a wheeled robot does not slide sideways
      double off_m = 1e9;
      for (const Point2& point : line) {
        off_m = std::min(off_m,
                         std::hypot(point.x_m - poses[k].pose.x_m, point.y_m - poses[k].pose.y_m));
      }
      ASSERT_LE(off_m, 0.2);
    }
    EXPECT_NEAR(way_m, 15.0, 0.05);
  }
}

}  // namespace
}  // namespace semview::simulation
