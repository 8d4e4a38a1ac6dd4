// SPDX-License-Identifier: Apache-2.0
#include "semview/field/floor_height.hpp"

#include <gtest/gtest.h>

namespace semview::field {
namespace {

constexpr ClassId kFloor = 1;
constexpr ClassId kTable = 2;

/// A level square that faces up.
void add_square(map::TriangleMesh& mesh, float side_m, float z_m, ClassId label) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(),
                       {{0, 0, z_m}, {side_m, 0, z_m}, {side_m, side_m, z_m}, {0, side_m, z_m}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
  mesh.labels.insert(mesh.labels.end(), 2, label);
}

TEST(FloorHeightTest, IsThatOfTheClassFloor) {
  map::TriangleMesh mesh;
  add_square(mesh, 3.0F, 0.71F, kTable);
  add_square(mesh, 1.0F, -0.02F, kFloor);
  EXPECT_NEAR(floor_height_m(mesh, kFloor, 0.05), -0.02, 1e-6);
}

TEST(FloorHeightTest, WithoutTheClassItIsTheLowestLargeLevelSurface) {
  map::TriangleMesh mesh;
  add_square(mesh, 3.0F, 0.31F, kTable);
  add_square(mesh, 2.0F, 1.02F, kTable);
  add_square(mesh, 0.5F, -0.40F, kTable);  // what noise leaves
  EXPECT_NEAR(floor_height_m(mesh, kNoHit, 0.05), 0.31, 1e-6);
}

TEST(FloorHeightTest, ACeilingIsNone) {
  map::TriangleMesh mesh;
  add_square(mesh, 1.0F, 0.0F, kTable);
  add_square(mesh, 9.0F, -1.0F, kTable);
  for (std::size_t k = 2; k < 4; ++k) std::swap(mesh.triangles[k][0], mesh.triangles[k][1]);
  EXPECT_NEAR(floor_height_m(mesh, kNoHit, 0.05), 0.0, 1e-6);
}

}  // namespace
}  // namespace semview::field
