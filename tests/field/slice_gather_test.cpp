// SPDX-License-Identifier: Apache-2.0
#include "semview/field/slice_gather.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "semview/core/random.hpp"
#include "support/only_target.hpp"

namespace semview::field {
namespace {

LossSlice random_slice(int columns, int rows, Rng& rng) {
  LossSlice slice(columns, rows);
  const auto cells = static_cast<std::size_t>(columns * rows);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    slice.set(cell, static_cast<std::uint16_t>(rng.uniform(0.0, 64000.0)));
  }
  return slice;
}

/// Poses in and round a grid; some on the edges of cells, where rounding decides.
PoseLanes random_poses(std::size_t count, int columns, int rows, Rng& rng) {
  PoseLanes poses(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double yaw = rng.uniform(-3.2, 3.2);
    poses.x_cells[i] = static_cast<float>(rng.uniform(-5.0, columns + 5.0));
    poses.y_cells[i] = static_cast<float>(rng.uniform(-5.0, rows + 5.0));
    if (i % 5 == 0) poses.x_cells[i] = std::round(poses.x_cells[i]);
    poses.cos_yaw[i] = i % 7 == 0 ? 0.0F : static_cast<float>(std::cos(yaw));
    poses.sin_yaw[i] = i % 7 == 0 ? 1.0F : static_cast<float>(std::sin(yaw));
  }
  return poses;
}

std::vector<SliceVoxel> random_voxels(std::size_t count, Rng& rng) {
  std::vector<SliceVoxel> voxels(count);
  for (SliceVoxel& voxel : voxels) {
    voxel = {std::floor(static_cast<float>(rng.uniform(-20.0, 20.0))) + 0.5F,
             std::floor(static_cast<float>(rng.uniform(-20.0, 20.0))) + 0.5F,
             static_cast<std::int32_t>(rng.uniform(1.0, 300.0))};
  }
  return voxels;
}

TEST(SliceGatherTest, EveryTargetAddsWhatThePoseAloneAdds) {
  Rng rng(11, "slice");
  for (const auto& [columns, rows] : {std::pair{31, 17}, std::pair{8, 40}, std::pair{1, 1}}) {
    const LossSlice slice = random_slice(columns, rows, rng);
    const PoseLanes poses = random_poses(300, columns, rows, rng);
    const std::vector<SliceVoxel> voxels = random_voxels(77, rng);
    const std::size_t padded = poses.x_cells.size();
    ASSERT_EQ(padded, 384U);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      const OnlyTarget only(target);
      std::vector<std::int64_t> sums(padded, 5);
      add_losses(slice, voxels, poses, 128, padded, sums);
      for (std::size_t i = 0; i < padded; ++i) {
        const std::int64_t added = i < 128 ? 0 : loss_of_pose(slice, voxels, poses, i);
        ASSERT_EQ(sums[i], 5 + added) << hwy::TargetName(target) << ", pose " << i;
      }
    }
  }
}

TEST(SliceGatherTest, SumsOfAsManyPixelsAsAllowedDoNotOverflow) {
  LossSlice slice(3, 3);
  for (std::size_t cell = 0; cell < 9; ++cell) slice.set(cell, 65535);
  const PoseLanes poses(1);
  const std::vector<SliceVoxel> voxels = {{900.0F, 0.0F, 65535}, {0.5F, -900.0F, 1}};
  std::vector<std::int64_t> sums(PoseLanes::kPad);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    const OnlyTarget only(target);
    std::ranges::fill(sums, 0);
    add_losses(slice, voxels, poses, 0, PoseLanes::kPad, sums);
    EXPECT_EQ(sums[0], std::int64_t{65535} * 65536);
  }
}

TEST(SliceGatherTest, WhatLiesBeyondHasTheLossOfTheNearestCell) {
  LossSlice slice(2, 2);
  slice.set(0, 1);
  slice.set(1, 2);
  slice.set(2, 11);
  slice.set(3, 12);
  const auto loss_at = [&slice](float x_cells, float y_cells) {
    PoseLanes poses(1);
    poses.cos_yaw[0] = 1.0F;
    const std::vector<SliceVoxel> voxel = {{x_cells, y_cells, 1}};
    return loss_of_pose(slice, voxel, poses, 0);
  };
  EXPECT_EQ(loss_at(0.0F, 0.0F), 1);
  EXPECT_EQ(loss_at(1.99F, 0.5F), 2);
  EXPECT_EQ(loss_at(0.5F, 1.5F), 11);
  EXPECT_EQ(loss_at(1.5F, 1.5F), 12);
  for (const float out : {-0.01F, -1.5F, -1e6F}) {
    EXPECT_EQ(loss_at(out, 1.5F), 11);
    EXPECT_EQ(loss_at(1.5F, out), 2);
  }
  for (const float out : {2.0F, 2.1F, 1e6F}) {
    EXPECT_EQ(loss_at(out, 0.5F), 2);
    EXPECT_EQ(loss_at(0.5F, out), 11);
  }
}

}  // namespace
}  // namespace semview::field
