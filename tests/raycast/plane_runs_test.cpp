// SPDX-License-Identifier: Apache-2.0
// Views with ranges: runs whose planes give back what the rays measured.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "raycast/small_worlds.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/mesh_cell_grid.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "support/paths.hpp"

namespace semview::raycast {
namespace {

constexpr double kEyeHeight_m = 1.2;
constexpr float kTolerance_m = 1e-3F;

/// What `view` with ranges has to share with the rays' own images.
void expect_sound(const Scene& scene, const PanoramaRequest& request) {
  const ColumnView view = render_column_view(scene, request, true);
  const Panorama panorama = render_panorama(scene, request);
  ASSERT_TRUE(view.has_ranges());
  ASSERT_EQ(view.to_labels(), panorama.labels);
  const RangeImage ranges = view.to_ranges(request.camera);
  for (int r = 0; r < request.camera.rows; ++r) {
    for (int c = 0; c < request.camera.columns; ++c) {
      const float cast = panorama.ranges_m.at(r, c);
      const float rebuilt = ranges.at(r, c);
      ASSERT_TRUE(cast == rebuilt || std::abs(cast - rebuilt) <= kTolerance_m)
          << rebuilt << " m for " << cast << " m at row " << r << ", column " << c << " from ("
          << request.map_from_robot.x_m << ", " << request.map_from_robot.y_m << ")";
    }
  }
}

class ShippedRangesTest : public testing::TestWithParam<std::string> {};

TEST_P(ShippedRangesTest, RebuiltRangesAreTheRaysWithinAMillimetre) {
  const auto map = map::load_map(std::string(SEMVIEW_SOURCE_DIR "/maps/") + GetParam());
  ASSERT_TRUE(map) << map.error().message;
  const map::ColumnMap* plan = map->columns();
  const auto scene = Scene::build(plan != nullptr ? map::extrude(*plan) : map->mesh()->mesh);
  ASSERT_TRUE(scene);
  const map::CellGrid grid = plan != nullptr
                                 ? map::build_cell_grid(*plan, kEyeHeight_m)
                                 : *build_cell_grid(*scene, map->ground_height_m, kEyeHeight_m);
  std::vector<CellIndex> cells = grid.free_cells();
  std::erase_if(cells, [&](const CellIndex& cell) { return !grid.has_eye(cell); });
  for (std::size_t i = 0; i < cells.size(); i += cells.size() / 20) {
    const PanoramaRequest request{
        PoseGrid::center(cells[i]), map->ground_height_m + kEyeHeight_m, {}, {}};
    expect_sound(*scene, request);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Maps,
    ShippedRangesTest,
    testing::Values("duplex_level1", "duplex_level2", "duplex_building", "largebuilding_level1"),
    [](const auto& map) { return map.param; });

TEST(PlaneRunsTest, AFaceOfABoxIsOneRunAColumn) {
  const auto scene = Scene::build(box_room({-2.0F, -3.0F, 0.0F}, {4.0F, 3.0F, 2.5F}));
  const PanoramaRequest request{{0.3, 0.4, 0.7}, 1.2, {120, 180, -1.5, 1.5}, {}};
  const ColumnView view = render_column_view(*scene, request, true);
  for (int c = 0; c < view.columns(); ++c) EXPECT_EQ(view.column(c).size(), 3U) << "column " << c;
  expect_sound(*scene, request);
}

TEST(PlaneRunsTest, RangesAreTrueMetresOfASkewedPlan) {
  Rng rng(7, "ranges");
  const map::ColumnMap plan = random_plan(rng, 13, 17);
  const auto scene = Scene::build(map::extrude(plan));
  const Eigen::Vector2d eye = plan.pixel_center({6, 8});
  expect_sound(*scene, {{eye.x(), eye.y(), 0.3}, 1.2, {}, {1.1, 0.9, 0.2}});
}

TEST(PlaneRunsTest, SlopesAndOpenAirKeepTheirRanges) {
  Rng rng(8, "slopes");
  const auto scene = Scene::build(random_mesh(rng, 200));
  expect_sound(*scene, {{0.1, -0.2, 0.4}, 0.1, {240, 120, -1.5, 1.5}, {}});
}

TEST(PlaneRunsTest, ASurfaceThatTheEyeTouchesIsAtNoDistance) {
  const auto scene = Scene::build(box_room({0.0F, -3.0F, 0.0F}, {4.0F, 3.0F, 2.5F}));
  expect_sound(*scene, {{0.0, 0.0, 0.0}, 1.2, {}, {}});
}

}  // namespace
}  // namespace semview::raycast
