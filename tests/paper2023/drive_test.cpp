// SPDX-License-Identifier: Apache-2.0
#include "experiments/paper2023/drive.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "experiments/paper2023/session.hpp"

namespace semview::paper2023 {
namespace {

double length_m(const std::vector<Pose2>& way) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += distance_m(way[i - 1], way[i]);
  return length;
}

TEST(DriveTest, WaysAreTenMetresOfFreeFloor) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Flat flat = change(draw_flat({}, seed), {}, seed);
    const DriveConfig config;
    const std::vector<Pose2> way = plan_drive(flat, config, seed);
    EXPECT_NEAR(length_m(way), 10.0, 1.0) << "seed " << seed;
    const paper2017::Scene scene = scene_of(flat);
    for (std::size_t i = 1; i < way.size(); ++i) {
      EXPECT_LE(distance_m(way[i - 1], way[i]), config.step_m + 1e-9);
      EXPECT_FALSE(scene.blocked(way[i].x_m, way[i].y_m, 0.14, 0.02, 1.1)) << "seed " << seed;
    }
  }
}

TEST(DriveTest, ASurveyLooksRoundInEveryRoom) {
  const Flat flat = draw_flat({}, 1);
  const std::vector<Pose2> way = plan_survey(flat, {}, 1);
  for (const Area& room : flat.rooms) {
    int inside = 0;
    for (const Pose2& pose : way) {
      inside += pose.x_m > room.min_x_m && pose.x_m < room.max_x_m && pose.y_m > room.min_y_m &&
                pose.y_m < room.max_y_m;
    }
    EXPECT_GE(inside, 3 * 18);
  }
}

TEST(DriveTest, OdometryWithoutNoiseIsTheTruth) {
  const std::vector<Pose2> way{{1.0, 2.0, 0.5}, {1.5, 2.2, 0.9}, {1.7, 2.9, -3.0}};
  const std::vector<Pose2> odometry = odometry_of(way, {0.0, 0.0, 0.0, 0.0}, 1);
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Pose2 back = way.front() * odometry[i];
    EXPECT_NEAR(back.x_m, way[i].x_m, 1e-12);
    EXPECT_NEAR(back.y_m, way[i].y_m, 1e-12);
    EXPECT_NEAR(wrap_angle(back.yaw_rad - way[i].yaw_rad), 0.0, 1e-12);
  }
}

TEST(DriveTest, OdometryDriftsAsConfigured) {
  // Straight on for 4 m in steps of 25 cm: heading off by drift·√4.
  std::vector<Pose2> way;
  for (int i = 0; i <= 16; ++i) way.push_back({0.25 * i, 0.0, 0.0});
  double squares = 0.0;
  constexpr int kDrives = 2000;
  for (int seed = 0; seed < kDrives; ++seed) {
    const auto odometry =
        odometry_of(way, {0.0, 0.015, 0.0, 0.0}, static_cast<std::uint64_t>(seed));
    squares += odometry.back().yaw_rad * odometry.back().yaw_rad;
  }
  EXPECT_NEAR(std::sqrt(squares / kDrives), 0.030, 4.0 * 0.030 / std::sqrt(2.0 * kDrives));
}

}  // namespace
}  // namespace semview::paper2023
