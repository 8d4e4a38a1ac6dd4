// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/voxel_reduction.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include <gtest/gtest.h>

#include "semview/core/random.hpp"

namespace semview::observation {
namespace {

DepthObservation random_observation() {
  Rng rng(3, "depth");
  DepthObservation seen;
  seen.classes = ClassTable({"wall", "table"});
  seen.camera = {20, 15, 18.0, 19.0, 9.5, 7.0};
  seen.depth_m = Image<float>(15, 20);
  seen.labels = LabelImage(15, 20);
  for (float& depth : seen.depth_m.pixels()) depth = static_cast<float>(rng.uniform(0.3, 3.0));
  for (ClassId& label : seen.labels.pixels()) {
    label = static_cast<ClassId>(rng.uniform(1.0, 2.999));
  }
  seen.base_from_camera.translate(Eigen::Vector3d(0.2, -0.1, 1.1));
  seen.base_from_camera.rotate(Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, -2, 3).normalized()));
  seen.stamp_s = 12.5;
  return seen;
}

TEST(VoxelReductionTest, EachPixelIsCountedInTheVoxelThatContainsItsPoint) {
  const DepthObservation seen = random_observation();
  std::map<std::tuple<int, int, int, int>, unsigned> counts;  // label, z, y, x
  for (int row = 0; row < 15; ++row) {
    for (int column = 0; column < 20; ++column) {
      const Eigen::Vector3d point =
          seen.base_from_camera *
          (static_cast<double>(seen.depth_m.at(row, column)) * seen.camera.direction(row, column));
      const Eigen::Vector3d cell = (point / 0.25).array().floor();
      ++counts[{seen.labels.at(row, column),
                static_cast<int>(cell.z()),
                static_cast<int>(cell.y()),
                static_cast<int>(cell.x())}];
    }
  }
  const auto list = reduce(seen, {.voxel_m = 0.25});
  ASSERT_TRUE(list.has_value()) << list.error().message;
  EXPECT_EQ(list->voxel_m, 0.25);
  EXPECT_EQ(list->stamp_s, 12.5);
  EXPECT_EQ(list->classes, seen.classes);
  ASSERT_EQ(list->voxels.size(), counts.size());
  EXPECT_LT(counts.size(), 300U);
  auto expected = counts.begin();  // in the list's order
  for (const ObservedVoxel& voxel : list->voxels) {
    EXPECT_EQ(std::tuple(int{voxel.label}, int{voxel.z}, int{voxel.y}, int{voxel.x}),
              expected->first);
    EXPECT_EQ(voxel.count, expected->second);
    ++expected;
  }
}

TEST(VoxelReductionTest, PixelsWithoutUsableDepthAreLeftOut) {
  DepthObservation seen = random_observation();
  std::ranges::fill(seen.depth_m.pixels(), 0.0F);
  seen.depth_m.at(1, 1) = std::numeric_limits<float>::quiet_NaN();
  seen.depth_m.at(1, 2) = std::numeric_limits<float>::infinity();
  seen.depth_m.at(1, 3) = -1.0F;
  seen.depth_m.at(1, 4) = 5.1F;
  EXPECT_FALSE(reduce(seen).has_value());
  seen.depth_m.at(1, 5) = 5.0F;
  const auto list = reduce(seen);
  ASSERT_TRUE(list.has_value());
  ASSERT_EQ(list->voxels.size(), 1U);
  EXPECT_EQ(list->voxels[0].count, 1U);
}

TEST(VoxelReductionTest, ALabelThatIsNoClassIsUnknown) {
  DepthObservation seen = random_observation();
  for (const ClassId label : {kNoHit, ClassId{3}, kUnknown}) {
    std::ranges::fill(seen.labels.pixels(), label);
    const auto list = reduce(seen);
    ASSERT_TRUE(list.has_value());
    for (const ObservedVoxel& voxel : list->voxels) EXPECT_EQ(voxel.label, kUnknown);
  }
  const auto labelled = reduce(seen);
  seen.labels = LabelImage();
  EXPECT_EQ(*reduce(seen), *labelled);
}

TEST(VoxelReductionTest, ObservationsThatDoNotFitTogetherAreRefused) {
  DepthObservation small = random_observation();
  small.depth_m = Image<float>(14, 20, 1.0F);
  EXPECT_FALSE(reduce(small).has_value());
  DepthObservation labels = random_observation();
  labels.labels = LabelImage(15, 19);
  EXPECT_FALSE(reduce(labels).has_value());
  DepthObservation camera = random_observation();
  camera.camera.fx_px = 0.0;
  EXPECT_FALSE(reduce(camera).has_value());
  camera.camera.fx_px = std::nan("");
  EXPECT_FALSE(reduce(camera).has_value());
  DepthObservation mounting = random_observation();
  mounting.base_from_camera.translation().x() = 1e9;
  EXPECT_FALSE(reduce(mounting).has_value());
  mounting.base_from_camera.translation().x() = std::nan("");
  EXPECT_FALSE(reduce(mounting).has_value());
  EXPECT_EQ(reduce(random_observation(), {.voxel_m = 0.0}).error().field, "voxel");
  EXPECT_EQ(reduce(random_observation(), {.max_depth_m = 0.05}).error().field, "max_depth");
}

}  // namespace
}  // namespace semview::observation
