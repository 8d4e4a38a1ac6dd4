// SPDX-License-Identifier: Apache-2.0
#include "semview/simulation/photograph.hpp"

#include <gtest/gtest.h>

#include "semview/geometry/angle.hpp"

namespace semview::simulation {
namespace {

constexpr LabelGeometry kGeometry{kTwoPi / 360.0, kPi / 2.0 / 90.0, true};

/// Floor below, wall above, with a door.
LabelImage scene() {
  LabelImage labels(90, 360, 1);
  for (int r = 60; r < 90; ++r) {
    for (int c = 0; c < 360; ++c) labels.at(r, c) = 2;
  }
  for (int r = 20; r < 60; ++r) {
    for (int c = 100; c < 140; ++c) labels.at(r, c) = 3;
  }
  return labels;
}

double recall(const LabelImage& truth, const LabelImage& seen, ClassId was, ClassId should_be) {
  double all = 0.0;
  double right = 0.0;
  for (std::size_t i = 0; i < truth.pixels().size(); ++i) {
    if (truth.pixels()[i] != was) continue;
    all += 1.0;
    right += seen.pixels()[i] == should_be ? 1.0 : 0.0;
  }
  return right / all;
}

TEST(PhotographTest, ErrsAsOftenAsNetworksDoAndInPatches) {
  const std::vector<ClassFate> fates = photograph_fates({"wall", "floor", "door"});
  PhotographConfig config;
  config.fair_share = 0.0;
  config.poor_share = 0.0;
  const LabelImage truth = scene();
  double wall = 0.0;
  double floor = 0.0;
  double door = 0.0;
  constexpr int kPictures = 25;
  int changes = 0;
  for (int k = 0; k < kPictures; ++k) {
    Rng rng(1, "photograph", static_cast<std::uint64_t>(k));
    const LabelImage seen = photograph(truth, kGeometry, fates, config, rng);
    wall += recall(truth, seen, 1, fates[1].right) / kPictures;
    floor += recall(truth, seen, 2, fates[2].right) / kPictures;
    door += recall(truth, seen, 3, fates[3].right) / kPictures;
    for (int c = 1; c < 360; ++c) changes += seen.at(75, c) != seen.at(75, c - 1) ? 1 : 0;
  }
  // σ of a class's recall is 0.1 a picture, so 0.02 over 25; borders cost some more.
  EXPECT_NEAR(wall, 0.87, 0.06);
  EXPECT_NEAR(floor, 0.77, 0.06);
  EXPECT_NEAR(door, 0.29, 0.08);
  EXPECT_LT(changes / kPictures, 60);  // of 359: patches, not salt
}

TEST(PhotographTest, TheSameStreamGivesTheSamePicture) {
  const std::vector<ClassFate> fates = photograph_fates({"wall", "floor", "door"});
  Rng a(7);
  Rng b(7);
  EXPECT_EQ(photograph(scene(), kGeometry, fates, {}, a),
            photograph(scene(), kGeometry, fates, {}, b));
}

}  // namespace
}  // namespace semview::simulation
