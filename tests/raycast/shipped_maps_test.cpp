// SPDX-License-Identifier: Apache-2.0
// The plans in maps/: real buildings, at 2 cm.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "semview/map/cell_grid.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "support/paths.hpp"

namespace semview::raycast {
namespace {

constexpr double kEyeHeight_m = 1.2;

class ShippedMapTest : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const auto map = map::load_map(std::string(SEMVIEW_SOURCE_DIR "/maps/") + GetParam());
    ASSERT_TRUE(map) << map.error().message;
    plan_ = *map->columns();
    mesh_ = map::extrude(plan_);
    const map::CellGrid grid = map::build_cell_grid(plan_, kEyeHeight_m);
    for (const CellIndex& cell : grid.free_cells()) {
      if (grid.has_eye(cell)) cells_.push_back(cell);  // not in an open door's leaf
    }
    eye_z_m_ = map->ground_height_m + kEyeHeight_m;
    ASSERT_GT(cells_.size(), 1000U);
  }

  /// About `count` poses over all free space.
  std::vector<Pose2> poses(std::size_t count) const {
    std::vector<Pose2> result;
    for (std::size_t i = 0; i < cells_.size(); i += cells_.size() / count) {
      result.push_back(PoseGrid::center(cells_[i]));
    }
    return result;
  }

  /// Walks along a ray, a quarter of a pixel a step: true if it comes to the outside of the
  /// building through an edge that is drawn without a wall, before it comes to anything solid.
  bool leaves_through_an_open_edge(const Pose2& pose, const Eigen::Vector3d& direction) const {
    for (double t = 0.0; t < 200.0; t += 0.005) {
      const Eigen::Vector3d point = Eigen::Vector3d(pose.x_m, pose.y_m, eye_z_m_) + t * direction;
      const ColumnProfile* profile = plan_.at(point.x(), point.y());
      if (profile == nullptr || profile->outside) return true;
      if (point.z() < plan_.ground_height_m || point.z() > plan_.ceiling->height_m) return false;
      if (profile->reaches_into(point.z() - 1e-9, point.z() + 1e-9)) return false;
    }
    return false;
  }

  map::ColumnMap plan_;
  map::TriangleMesh mesh_;
  std::vector<CellIndex> cells_;
  double eye_z_m_ = 0.0;
};

TEST_P(ShippedMapTest, NoRayLeavesTheBuildingWhereItIsClosed) {
  const PanoramaCamera camera{360, 180, -kPi / 2.0, kPi / 2.0};
  for (const bool robust : {true, false}) {
    const auto scene = Scene::build(mesh_, {robust});
    for (const Pose2& pose : poses(25)) {
      const Panorama panorama = render_panorama(*scene, {pose, eye_z_m_, camera, {}});
      for (int r = 0; r < camera.rows; ++r) {
        for (int c = 0; c < camera.columns; ++c) {
          if (panorama.labels.at(r, c) != kNoHit) continue;
          ASSERT_TRUE(leaves_through_an_open_edge(pose, camera.direction(r, c)))
              << "from (" << pose.x_m << ", " << pose.y_m << "), row " << r << ", column " << c;
        }
      }
    }
  }
}

TEST_P(ShippedMapTest, PacketsAreSingleRays) {
  const auto scene = Scene::build(mesh_);
  for (const Pose2& pose : poses(25)) {
    const PanoramaRequest request{pose, eye_z_m_, {}, {}};
    const Panorama packets = render_panorama(*scene, request);
    const Panorama singles = render_panorama_single_rays(*scene, request);
    ASSERT_EQ(packets.labels, singles.labels) << "from (" << pose.x_m << ", " << pose.y_m << ")";
    for (std::size_t i = 0; i < packets.ranges_m.pixels().size(); ++i) {
      const float a = packets.ranges_m.pixels()[i];
      const float b = singles.ranges_m.pixels()[i];
      ASSERT_TRUE(a == b || std::abs(a - b) <= 1e-5F * (1.0F + a)) << a << " and " << b;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Maps,
                         ShippedMapTest,
                         testing::Values("duplex_level1", "duplex_level2", "largebuilding_level1"),
                         [](const auto& map) { return map.param; });

}  // namespace
}  // namespace semview::raycast
