// SPDX-License-Identifier: Apache-2.0
#include "semview/field/fusion.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "semview/field/volume_mesh.hpp"

namespace semview::field {
namespace {

constexpr ClassId kWall = 1;
constexpr ClassId kSofa = 2;

PinholeCamera small_camera() { return {80, 60, 65.0, 65.0, 40.0, 30.0}; }

/// Looks at a wall 2 m ahead whose right half is a sofa.
DepthFrame facing_a_wall() {
  DepthFrame frame;
  frame.camera = small_camera();
  frame.depth_m = Image<float>(60, 80, 2.0F);
  frame.labels = LabelImage(60, 80, kWall);
  for (int r = 0; r < 60; ++r) {
    for (int c = 40; c < 80; ++c) frame.labels.at(r, c) = kSofa;
  }
  return frame;
}

SemanticVolume empty_volume() { return {VolumeShape{}, ClassTable({"wall", "sofa"})}; }

class FusionTest : public ::testing::Test {
 protected:
  FusedFrame take(const DepthFrame& frame) {
    const auto fused = fuse(frame, {}, pool_, volume_);
    EXPECT_TRUE(fused) << fused.error().message;
    return fused.value_or(FusedFrame{});
  }
  std::string refusal(const DepthFrame& frame) {
    const auto fused = fuse(frame, {}, pool_, volume_);
    return fused ? "" : fused.error().message;
  }

  ThreadPool pool_{2};
  SemanticVolume volume_ = empty_volume();
};

TEST_F(FusionTest, AVoxelHoldsTheDistanceFromItsCentreToTheWallAlongTheAxis) {
  take(facing_a_wall());
  for (const double z : {1.86, 1.97, 2.02, 2.13}) {
    const VoxelIndex voxel = volume_.voxel_at({0.1, -0.2, z});
    EXPECT_EQ(volume_.weight(voxel), 1.0F);
    EXPECT_NEAR(volume_.sdf_m(voxel), 2.0 - volume_.centre(voxel).z(), 1e-6);
  }
}

TEST_F(FusionTest, DistancesEndAtTheTruncationDistanceAndNothingIsKnownBehindIt) {
  take(facing_a_wall());
  EXPECT_EQ(volume_.sdf_m(volume_.voxel_at({0.0, 0.0, 1.7})), 0.2F);
  EXPECT_EQ(volume_.weight(volume_.voxel_at({0.0, 0.0, 2.27})), 0.0F);
}

TEST_F(FusionTest, VoxelsAtTheSurfaceHaveTheClassThatWasSeenThere) {
  take(facing_a_wall());
  EXPECT_EQ(volume_.most_likely_class(volume_.voxel_at({-0.3, 0.1, 2.01})), kWall);
  EXPECT_EQ(volume_.most_likely_class(volume_.voxel_at({0.3, 0.1, 2.01})), kSofa);
  EXPECT_EQ(volume_.most_likely_class(volume_.voxel_at({0.3, 0.1, 1.8})), kNoHit);
}

TEST_F(FusionTest, TheClassSeenMostOftenWins) {
  DepthFrame frame = facing_a_wall();
  take(frame);
  frame.labels = LabelImage(60, 80, kWall);
  take(frame);
  take(frame);
  EXPECT_EQ(volume_.most_likely_class(volume_.voxel_at({0.3, 0.1, 2.01})), kWall);
}

TEST_F(FusionTest, TwoMeasurementsOfOneWallAreAveraged) {
  DepthFrame frame = facing_a_wall();
  take(frame);
  frame.depth_m = Image<float>(60, 80, 2.04F);
  take(frame);
  const VoxelIndex voxel = volume_.voxel_at({0.1, -0.2, 2.0});
  EXPECT_EQ(volume_.weight(voxel), 2.0F);
  EXPECT_NEAR(volume_.sdf_m(voxel), 2.02 - volume_.centre(voxel).z(), 1e-6);
}

TEST_F(FusionTest, UnknownLabelsAndPixelsWithoutDepthTellNothing) {
  DepthFrame frame = facing_a_wall();
  frame.labels = LabelImage(60, 80, kUnknown);
  for (int r = 0; r < 60; ++r) {
    for (int c = 0; c < 40; ++c) frame.depth_m.at(r, c) = 0.0F;
    frame.depth_m.at(r, 79) = std::numeric_limits<float>::quiet_NaN();
  }
  const FusedFrame fused = take(frame);
  EXPECT_EQ(fused.depth_pixels, 60U * 39U);
  EXPECT_EQ(volume_.most_likely_class(volume_.voxel_at({0.3, 0.1, 2.01})), kNoHit);
  EXPECT_EQ(volume_.weight(volume_.voxel_at({-0.3, 0.1, 2.01})), 0.0F);
}

TEST_F(FusionTest, ACameraElsewherePutsItsWallElsewhere) {
  DepthFrame frame = facing_a_wall();
  // Looking along x from (1, 2, 1.5): x of the map is forward, z up.
  frame.map_from_camera.linear() = (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished();
  frame.map_from_camera.translation() = Eigen::Vector3d(1.0, 2.0, 1.5);
  take(frame);
  const VoxelIndex voxel = volume_.voxel_at({2.96, 2.2, 1.6});
  EXPECT_NEAR(volume_.sdf_m(voxel), 3.0 - volume_.centre(voxel).x(), 1e-6);
}

TEST_F(FusionTest, FramesThatDoNotFitAreRefusedInOneLine) {
  DepthFrame frame = facing_a_wall();
  frame.labels = LabelImage(60, 81, kWall);
  EXPECT_EQ(refusal(frame), "labels of 81 x 60 pixels, the camera has 80 x 60");
  frame = facing_a_wall();
  frame.depth_m = Image<float>(60, 80, 7.0F);
  EXPECT_EQ(refusal(frame), "no depth between 0.1 and 5 m");
  frame = facing_a_wall();
  frame.map_from_camera.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(frame), "the pose is not finite");
  EXPECT_EQ(volume_.block_count(), 0U);
}

TEST_F(FusionTest, TheVolumeIsTheSameForAnyNumberOfThreads) {
  take(facing_a_wall());
  ThreadPool single(1);
  SemanticVolume other = empty_volume();
  ASSERT_TRUE(fuse(facing_a_wall(), {}, single, other));
  ASSERT_EQ(volume_.block_indices(), other.block_indices());
  for (const auto& index : other.block_indices()) {
    EXPECT_EQ(volume_.block(index)->sdf_m, other.block(index)->sdf_m);
    EXPECT_EQ(volume_.block(index)->weight, other.block(index)->weight);
  }
}

TEST_F(FusionTest, TheMeshOfAWallIsTheWallItsClassesItsClasses) {
  take(facing_a_wall());
  const auto mesh = mesh_of(volume_, {.min_weight = 1.0F}, pool_);
  ASSERT_TRUE(mesh) << mesh.error().message;
  std::size_t sofa = 0;
  for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
    const auto& [a, b, c] = mesh->triangles[t];
    const Eigen::Vector3f& corner = mesh->vertices[a];
    EXPECT_NEAR(corner.z(), 2.0, 1e-3);
    // Seen from the camera, which looks along z.
    const Eigen::Vector3f normal = (mesh->vertices[b] - corner).cross(mesh->vertices[c] - corner);
    EXPECT_LT(normal.z(), 0.0F);
    if (std::abs(corner.x()) > 0.15F) {
      EXPECT_EQ(mesh->labels[t], corner.x() > 0.0F ? kSofa : kWall);
    }
    if (mesh->labels[t] == kSofa) ++sofa;
  }
  EXPECT_GT(sofa, 100U);
}

}  // namespace
}  // namespace semview::field
