// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/mesh_cell_grid.hpp"

#include <gtest/gtest.h>

#include "raycast/small_worlds.hpp"

namespace semview::raycast {
namespace {

/// A closed box seen from outside: a piece of furniture, or a wall.
void add_solid(map::TriangleMesh& mesh, const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  map::TriangleMesh box = box_room(low, high);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), box.vertices.begin(), box.vertices.end());
  for (const auto& [a, b, c] : box.triangles) {
    mesh.triangles.push_back({first + a, first + c, first + b});
    mesh.labels.push_back(9);
  }
}

/// A 2 m × 1 m room at ground height 3: a table and a wardrobe in it, and a wall across its east
/// end that is thinner than a cell.
map::CellGrid furnished_room() {
  map::TriangleMesh mesh = box_room({0, 0, 3}, {2, 1, 5.5F});
  add_solid(mesh, {0.4F, 0.0F, 3.7F}, {0.6F, 1.0F, 3.75F});
  add_solid(mesh, {0.8F, 0.0F, 3.0F}, {1.0F, 0.5F, 5.0F});
  add_solid(mesh, {1.48F, 0.0F, 3.0F}, {1.52F, 1.0F, 5.5F});
  return *build_cell_grid(*Scene::build(mesh), 3.0, 1.2);
}

TEST(MeshCellGridTest, FreeIsWhereTheGroundIsSeenFromTheEye) {
  const map::CellGrid grid = furnished_room();
  EXPECT_TRUE(grid.is_free({0, 0}));
  EXPECT_TRUE(grid.is_free({19, 9}));
  EXPECT_FALSE(grid.is_free({4, 5})) << "a table";
  EXPECT_FALSE(grid.is_free({8, 2})) << "in the wardrobe";
  EXPECT_TRUE(grid.is_free({8, 7})) << "beside the wardrobe";
  EXPECT_FALSE(grid.is_free({-1, 0})) << "outside";
  EXPECT_FALSE(grid.is_free({20, 0})) << "outside";
}

TEST(MeshCellGridTest, TheEyeIsFreeOverTablesButNotInSolidsOrOutside) {
  const map::CellGrid grid = furnished_room();
  EXPECT_TRUE(grid.has_eye({4, 5}));
  EXPECT_FALSE(grid.has_eye({8, 2}));
  EXPECT_FALSE(grid.has_eye({-1, 0}));
}

TEST(MeshCellGridTest, NoStepLeadsThroughAWallThinnerThanACell) {
  const map::CellGrid grid = furnished_room();
  EXPECT_TRUE(grid.can_step({12, 3}, {13, 3}));
  EXPECT_TRUE(grid.can_step({12, 3}, {12, 4}));
  EXPECT_FALSE(grid.can_step({14, 3}, {15, 3}));
  EXPECT_FALSE(grid.can_step({7, 3}, {8, 3}));
  EXPECT_EQ(grid.components().size(), 3U) << "west of the table, its east, behind the wall";
}

TEST(MeshCellGridTest, RefusesAMeshThatIsTooWide) {
  EXPECT_EQ(
      build_cell_grid(*Scene::build(box_room({0, 0, 0}, {1e4F, 1e4F, 3})), 0.0, 1.2).error().code,
      ErrorCode::kResourceExhausted);
  EXPECT_EQ(
      build_cell_grid(*Scene::build(box_room({0, 0, 0}, {1e9F, 1, 3})), 0.0, 1.2).error().code,
      ErrorCode::kOutOfRange);
}

}  // namespace
}  // namespace semview::raycast
