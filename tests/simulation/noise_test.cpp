// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "semview/simulation/odometry_noise.hpp"
#include "semview/simulation/segmentation_noise.hpp"

namespace semview::simulation {
namespace {

// Twice round a square of 2 m: 16 m.
std::vector<io::StampedPose2> square_drive() {
  std::vector<io::StampedPose2> poses{{0.0, {1.0, 2.0, 0.5}}};
  for (int side = 0; side < 8; ++side) {
    for (int k = 0; k < 60; ++k) {
      const Pose2 step = k < 40 ? Pose2{0.05, 0.0, 0.0} : Pose2{0.0, 0.0, kPi / 40.0};
      poses.push_back({poses.back().stamp_s + 0.1, poses.back().pose * step});
    }
  }
  return poses;
}

TEST(OdometryNoiseTest, WithoutNoiseOdometryIsTheTruthSeenFromItsStart) {
  const auto truth = square_drive();
  Rng rng(1, "odometry");
  const auto odometry = simulate_odometry(truth, {}, 0.0, rng);
  ASSERT_EQ(odometry.size(), truth.size());
  EXPECT_EQ(odometry.front().pose, Pose2{});
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const Pose2 expected = inverse(truth.front().pose) * truth[k].pose;
    EXPECT_NEAR(distance_m(odometry[k].pose, expected), 0.0, 1e-9);
    EXPECT_EQ(odometry[k].stamp_s, truth[k].stamp_s);
  }
}

TEST(OdometryNoiseTest, ErrorOfAStraightDriveIsThatOfItsConstantParts) {
  std::vector<io::StampedPose2> truth;
  for (int k = 0; k <= 100; ++k) truth.push_back({0.1 * k, {0.1 * k, 0.0, 0.0}});
  OdometryNoiseConfig config;
  config.distance_walk_m = config.turn_walk_rad = config.drift_share = 0.0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Rng rng(seed, "odometry");
    const Pose2 end = simulate_odometry(truth, config, 1.0, rng).back().pose;
    const double veer = std::abs(end.yaw_rad) / 10.0;
    EXPECT_GE(veer, 0.7 * config.veer_rad_per_m - 1e-12);
    EXPECT_LE(veer, 1.3 * config.veer_rad_per_m + 1e-12);
    const double way_m = 10.0 * std::hypot(end.x_m, end.y_m) / 10.0;
    EXPECT_NEAR(way_m, 10.0, 10.0 * 1.3 * config.distance_error + 0.05);
    // A circle's arc: the end lies to the side by about veer · way² / 2.
    EXPECT_NEAR(std::abs(end.y_m), 0.5 * veer * way_m * way_m, 0.06);
  }
}

TEST(OdometryNoiseTest, FinalErrorIsTheConfiguredShareOfAWayThatLeadsSomewhere) {
  // A drive that goes somewhere: 8 m, a quarter turn, 8 m.
  std::vector<io::StampedPose2> truth{{0.0, {1.0, 2.0, 0.5}}};
  for (int k = 0; k < 340; ++k) {
    const bool turning = k >= 160 && k < 180;
    const Pose2 step = turning ? Pose2{0.0, 0.0, kPi / 40.0} : Pose2{0.05, 0.0, 0.0};
    truth.push_back({truth.back().stamp_s + 0.1, truth.back().pose * step});
  }
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Rng rng(seed, "odometry");
    const Pose2 end = truth.front().pose * simulate_odometry(truth, {}, 1.0, rng).back().pose;
    const double error_m = distance_m(end, truth.back().pose);
    EXPECT_GE(error_m, 0.9 * 0.05 * 16.0 * 2.0 / 3.0) << seed;
    EXPECT_LE(error_m, 1.1 * 0.05 * 16.0 * 4.0 / 3.0) << seed;
  }
}

TEST(OdometryNoiseTest, OnAWayThereAndBackTheErrorIsAtMostTheConfiguredShare) {
  std::vector<io::StampedPose2> truth{{0.0, {}}};
  for (int k = 0; k < 360; ++k) {
    const bool turning = k >= 160 && k < 200;
    const Pose2 step = turning ? Pose2{0.0, 0.0, kPi / 40.0} : Pose2{0.05, 0.0, 0.0};
    truth.push_back({truth.back().stamp_s + 0.1, truth.back().pose * step});
  }
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Rng rng(seed, "odometry");
    const Pose2 end = simulate_odometry(truth, {}, 1.0, rng).back().pose;
    EXPECT_GT(distance_m(end, truth.back().pose), 0.05) << seed;
    EXPECT_LE(distance_m(end, truth.back().pose), 1.1 * 0.05 * 16.0 * 4.0 / 3.0) << seed;
  }
}

// A wall with a door in it, under a ceiling, over a floor; 1° a pixel.
LabelImage picture() {
  LabelImage labels(90, 360, 2);
  for (int r = 0; r < 20; ++r) std::fill(labels.row(r).begin(), labels.row(r).end(), ClassId{1});
  for (int r = 65; r < 90; ++r) std::fill(labels.row(r).begin(), labels.row(r).end(), ClassId{3});
  for (int r = 30; r < 65; ++r) {
    for (int c = 100; c < 130; ++c) labels.at(r, c) = 4;
  }
  return labels;
}

constexpr LabelGeometry kGeometry{kPi / 180.0, kPi / 180.0, true};

LabelImage noisy(const LabelImage& labels, double level, std::uint64_t seed) {
  Rng rng(seed, "segmentation");
  return add_segmentation_noise(labels, kGeometry, 6, {}, level, rng);
}

TEST(SegmentationNoiseTest, LevelZeroLeavesLabelsAlone) {
  EXPECT_EQ(noisy(picture(), 0.0, 1), picture());
}

TEST(SegmentationNoiseTest, ErrorsComeInPatchesNotInSinglePixels) {
  const LabelImage truth = picture();
  int wrong = 0;
  int lonely = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const LabelImage seen = noisy(truth, 1.0, seed);
    for (int r = 1; r + 1 < truth.rows(); ++r) {
      for (int c = 1; c + 1 < truth.columns(); ++c) {
        if (seen.at(r, c) == truth.at(r, c)) continue;
        ++wrong;
        int same = 0;
        for (int dr = -1; dr <= 1; ++dr) {
          for (int dc = -1; dc <= 1; ++dc) same += seen.at(r + dr, c + dc) == seen.at(r, c) ? 1 : 0;
        }
        lonely += same <= 2 ? 1 : 0;
      }
    }
  }
  const double share = wrong / (20.0 * 88 * 358);
  EXPECT_GT(share, 0.02);
  EXPECT_LT(share, 0.25);
  EXPECT_LT(lonely, wrong / 50);
}

TEST(SegmentationNoiseTest, EdgesWaverByAboutTheConfiguredAngle) {
  SegmentationNoiseConfig config;
  config.blobs_per_sr = 0.0;
  double squared = 0.0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Rng rng(seed, "edges");
    const LabelImage seen = add_segmentation_noise(picture(), kGeometry, 6, config, 1.0, rng);
    for (int c = 200; c < 340; ++c) {
      int edge = 0;
      while (seen.at(edge, c) == 1) ++edge;
      squared += (edge - 20) * (edge - 20);
    }
  }
  const double deviation_px = std::sqrt(squared / (50 * 140));
  // Bilinear between unit normals: between 0.5 and 1 of the nodes' own deviation, plus rounding.
  EXPECT_GT(deviation_px, 0.4);
  EXPECT_LT(deviation_px, 1.5);
}

TEST(SegmentationNoiseTest, OnlyKnownIdsAndUnknownAppear) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const LabelImage labels = noisy(picture(), 3.0, seed);
    for (const ClassId label : labels.pixels()) {
      ASSERT_TRUE((label >= 1 && label <= 6) || label == kUnknown) << int{label};
    }
  }
}

}  // namespace
}  // namespace semview::simulation
