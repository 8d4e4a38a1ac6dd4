// SPDX-License-Identifier: Apache-2.0
#include "semview/field/distance_field.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "field/field_scene.hpp"
#include "reference/field_likelihood.hpp"

namespace semview::field {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Eigen::Vector3d centre_of(const LayerGrid& grid, int column, int row, double z_m) {
  const Pose2 at =
      grid.map_from_grid * Pose2{(column + 0.5) * grid.cell_m, (row + 0.5) * grid.cell_m, 0.0};
  return {at.x_m, at.y_m, z_m};
}

/// Every `step`th cell's distances to classes and surface, as looking at everything says.
void expect_true(const DistanceField& field,
                 const reference::FieldTruth& truth,
                 double z_m,
                 int step,
                 double reach_m) {
  const LayerGrid& grid = field.grid();
  std::vector<float> found(grid.cells());
  for (int label = 0; label <= field.classes().size(); ++label) {
    const auto id = static_cast<ClassId>(label);
    if (label == 0) {
      field.sample_surface(z_m, found);
    } else {
      field.sample_class(id, z_m, found);
    }
    for (std::size_t i = 0; i < found.size(); i += static_cast<std::size_t>(step)) {
      const int cell = static_cast<int>(i);
      const Eigen::Vector3d point = centre_of(grid, cell % grid.columns, cell / grid.columns, z_m);
      double expected =
          label == 0 ? std::abs(truth.sdf_m(point)) : truth.class_distance_m(id, point);
      if (expected > reach_m + 1e-9) expected = kInfinity;
      const double distance = std::sqrt(static_cast<double>(found[i]));
      if (expected == kInfinity) {
        ASSERT_EQ(distance, kInfinity) << "class " << label << ", cell " << i;
      } else {
        ASSERT_NEAR(distance, expected, 1e-4) << "class " << label << ", cell " << i;
      }
    }
  }
}

TEST(DistanceFieldTest, DistancesOfAPlanAreThoseToTheNearestSlabGroundOrCeiling) {
  const map::ColumnMap plan = room();
  const auto field = distances_of_plan(plan, room_classes(), 0.05, 0.3);
  ASSERT_TRUE(field.has_value()) << field.error().message;
  const reference::PlanTruth truth(plan, room_classes(), 0.3);
  EXPECT_EQ((*field)->grid().columns, 60 + 12);
  EXPECT_EQ((*field)->grid().rows, 48 + 12);
  EXPECT_EQ((*field)->ground_height_m(), 0.2);
  for (const double z_m : {-0.1, 0.225, 0.9, 1.7, 2.3}) {
    expect_true(**field, truth, z_m, 11, kInfinity);
  }
}

TEST(DistanceFieldTest, ACellTakesTheDistanceOfThePixelUnderItsCentre) {
  const map::ColumnMap plan = room();
  const auto fine = distances_of_plan(plan, room_classes(), 0.05, 0.0);
  const auto coarse = distances_of_plan(plan, room_classes(), 0.15, 0.0);
  ASSERT_TRUE(fine.has_value() && coarse.has_value());
  const LayerGrid& grid = (*coarse)->grid();
  ASSERT_EQ(grid.columns, 20);
  ASSERT_EQ(grid.rows, 16);
  std::vector<float> fine_m2((*fine)->grid().cells());
  std::vector<float> coarse_m2(grid.cells());
  (*fine)->sample_class(4, 0.6, fine_m2);
  (*coarse)->sample_class(4, 0.6, coarse_m2);
  for (std::size_t row = 0; row < 16; ++row) {
    for (std::size_t column = 0; column < 20; ++column) {
      EXPECT_EQ(coarse_m2[row * 20 + column], fine_m2[(3 * row + 1) * 60 + 3 * column + 1]);
    }
  }
}

TEST(DistanceFieldTest, WhatAPlanDoesNotHaveIsInfinitelyFar) {
  const auto field = distances_of_plan(room(), room_classes());
  ASSERT_TRUE(field.has_value());
  std::vector<float> lamps((*field)->grid().cells());
  for (const ClassId absent : {ClassId{6}, kNoHit}) {
    (*field)->sample_class(absent, 1.0, lamps);
    for (const float distance : lamps) {
      ASSERT_EQ(distance, std::numeric_limits<float>::infinity());
    }
  }
}

TEST(DistanceFieldTest, CellsFinerThanThePlanAreRefused) {
  EXPECT_EQ(distances_of_plan(room(), room_classes(), 0.02).error().code,
            ErrorCode::kInvalidArgument);
  EXPECT_EQ(distances_of_plan(room(), room_classes(), 0.05, -1.0).error().code,
            ErrorCode::kInvalidArgument);
}

TEST(DistanceFieldTest, DistancesOfAVolumeAreThoseToTheNearestVoxelOfTheClass) {
  Rng rng(8, "volume");
  const map::ColumnMap plan = room();
  const SemanticVolume volume = volume_of_room(plan, rng);
  const auto field = distances_of_volume(volume, 0.2, SurfaceReach::kTruncation);
  ASSERT_TRUE(field.has_value()) << field.error().message;
  const reference::VolumeTruth truth(volume, 0.2, 1.0);
  for (const double z_m : {0.225, 1.225}) expect_true(**field, truth, z_m, 131, kInfinity);
}

TEST(DistanceFieldTest, BeyondItsReachAVolumeHasNothing) {
  Rng rng(8, "volume");
  const map::ColumnMap plan = room();
  const SemanticVolume volume = volume_of_room(plan, rng);
  const auto field = distances_of_volume(volume, 0.2, SurfaceReach::kTruncation, 0.4);
  ASSERT_TRUE(field.has_value()) << field.error().message;
  const reference::VolumeTruth truth(volume, 0.2, 1.0);
  expect_true(**field, truth, 1.525, 131, 0.4);
}

TEST(DistanceFieldTest, AVoxelThatWasNeverObservedHasTheTruncationDistance) {
  SemanticVolume volume({0.1, 0.35}, room_classes());
  VoxelBlock& block = volume.add_block({0, 0, 0});
  block.weight[SemanticVolume::place_in_block({3, 2, 1})] = 1.0F;
  block.sdf_m[SemanticVolume::place_in_block({3, 2, 1})] = -0.05F;
  const auto field = distances_of_volume(volume, 0.0, SurfaceReach::kTruncation, 6.0, 0.0);
  ASSERT_TRUE(field.has_value()) << field.error().message;
  std::vector<float> surface_m2(64);
  (*field)->sample_surface(0.15, surface_m2);
  for (std::size_t i = 0; i < 64; ++i)
    EXPECT_EQ(surface_m2[i], i == 2 * 8 + 3 ? 0.05F * 0.05F : 0.35F * 0.35F);
  (*field)->sample_surface(0.25, surface_m2);
  for (const float distance : surface_m2) EXPECT_EQ(distance, 0.35F * 0.35F);
}

TEST(DistanceFieldTest, WhereTheStoredDistancesEndTheNearestSurfaceVoxelCounts) {
  SemanticVolume volume({0.1, 0.35}, room_classes());
  VoxelBlock& block = volume.add_block({0, 0, 0});
  block.weight[SemanticVolume::place_in_block({3, 2, 1})] = 1.0F;
  block.sdf_m[SemanticVolume::place_in_block({3, 2, 1})] = -0.04F;
  block.weight[SemanticVolume::place_in_block({4, 2, 1})] = 1.0F;
  block.sdf_m[SemanticVolume::place_in_block({4, 2, 1})] = 0.07F;
  const auto field = distances_of_volume(volume, 0.0, SurfaceReach::kEverywhere, 6.0, 0.0);
  ASSERT_TRUE(field.has_value()) << field.error().message;
  for (int layer = 0; layer < 8; ++layer) {
    std::vector<float> surface_m2(64);
    (*field)->sample_surface(0.1 * layer + 0.05, surface_m2);
    for (int i = 0; i < 64; ++i) {
      const double dx = 0.1 * (i % 8 - 3);
      const double dy = 0.1 * (i / 8 - 2);
      const double dz = 0.1 * (layer - 1);
      double expected = std::max(0.35, std::sqrt(dx * dx + dy * dy + dz * dz));
      if (layer == 1 && i == 19) expected = 0.04;
      if (layer == 1 && i == 20) expected = 0.07;
      EXPECT_NEAR(std::sqrt(surface_m2[static_cast<std::size_t>(i)]), expected, 1e-5)
          << layer << ' ' << i;
    }
  }
}

TEST(DistanceFieldTest, AboveAndBelowAVolumeTheNearestLayerCounts) {
  Rng rng(8, "volume");
  const SemanticVolume volume = volume_of_room(room(), rng);
  const auto field = distances_of_volume(volume, 0.2, SurfaceReach::kTruncation);
  ASSERT_TRUE(field.has_value()) << field.error().message;
  std::vector<float> lowest((*field)->grid().cells());
  std::vector<float> below(lowest.size());
  (*field)->sample_class(1, 0.01, lowest);
  (*field)->sample_class(1, -0.01, below);
  EXPECT_EQ(lowest, below);
  (*field)->sample_surface(0.01, lowest);
  (*field)->sample_surface(-7.0, below);
  EXPECT_EQ(lowest, below);
}

TEST(DistanceFieldTest, AnEmptyVolumeAndAReachThatIsTooFarAreRefused) {
  SemanticVolume volume({0.05, 0.2}, room_classes());
  EXPECT_FALSE(distances_of_volume(volume, 0.0, SurfaceReach::kTruncation).has_value());
  volume.add_block({0, 0, 0});
  EXPECT_TRUE(distances_of_volume(volume, 0.0, SurfaceReach::kTruncation, 12.75).has_value());
  EXPECT_FALSE(distances_of_volume(volume, 0.0, SurfaceReach::kTruncation, 12.8).has_value());
  EXPECT_FALSE(
      distances_of_volume(volume, 0.0, SurfaceReach::kTruncation, std::nan("")).has_value());
  EXPECT_FALSE(distances_of_volume(volume, 0.0, SurfaceReach::kTruncation, 6.0, -0.1).has_value());
}

}  // namespace
}  // namespace semview::field
