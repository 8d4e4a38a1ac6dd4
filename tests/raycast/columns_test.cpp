// SPDX-License-Identifier: Apache-2.0
// The columns caster against Embree on the extruded plan.
#include <cmath>

#include <gtest/gtest.h>

#include "raycast/small_worlds.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/column_renderer.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "support/paths.hpp"

namespace semview::raycast {
namespace {

struct Difference {
  int labels = 0;
  int ranges = 0;
  int pixels = 0;
};

void compare(const Panorama& a, const Panorama& b, Difference& difference) {
  for (int r = 0; r < a.labels.rows(); ++r) {
    for (int c = 0; c < a.labels.columns(); ++c) {
      ++difference.pixels;
      if (a.labels.at(r, c) != b.labels.at(r, c)) {
        ++difference.labels;
      } else if (std::isfinite(a.ranges_m.at(r, c)) &&
                 std::abs(a.ranges_m.at(r, c) - b.ranges_m.at(r, c)) > 0.01F) {
        ++difference.ranges;
      }
    }
  }
}

TEST(ColumnsTest, RandomPlansLookAsEmbreeSeesThem) {
  Difference difference;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Rng rng(seed, "columns");
    const map::ColumnMap plan = random_plan(rng, 25, 31);
    const Scene scene = std::move(*Scene::build(map::extrude(plan), {true}));
    const ColumnScene columns = ColumnScene::build(plan);
    for (int i = 0; i < 10; ++i) {
      const Eigen::Vector2d xy = plan.map_from_plan(rng.uniform(0.6, 14.0), rng.uniform(0.6, 11.0));
      const ColumnProfile* profile = plan.at(xy.x(), xy.y());
      if (profile == nullptr || !profile->slabs.empty()) continue;
      const PanoramaRequest request{
          {xy.x(), xy.y(), rng.uniform(-3.0, 3.0)}, 1.2, {360, 90, -1.2, 1.2}, {}};
      compare(render_panorama(columns, request), render_panorama(scene, request), difference);
    }
  }
  EXPECT_LE(difference.labels, difference.pixels / 1'000'000 + 1) << difference.pixels;
  EXPECT_EQ(difference.ranges, 0);
}

TEST(ColumnsTest, ShippedPlansLookAsEmbreeSeesThem) {
  for (const char* name : {"duplex_level1", "duplex_level2", "largebuilding_level1", "tutorial"}) {
    const auto map = map::load_map(std::string(SEMVIEW_SOURCE_DIR "/maps/") + name);
    ASSERT_TRUE(map);
    const map::ColumnMap& plan = *map->columns();
    const Scene scene = std::move(*Scene::build(map::extrude(plan), {true}));
    const ColumnScene columns = ColumnScene::build(plan);
    Rng rng(1, name);
    Difference difference;
    const map::Bounds bounds = plan.bounds();
    int views = 0;
    while (views < 60) {
      const double x = std::round(rng.uniform(bounds.min_x_m, bounds.max_x_m) * 10) / 10 + 0.05;
      const double y = std::round(rng.uniform(bounds.min_y_m, bounds.max_y_m) * 10) / 10 + 0.05;
      const ColumnProfile* profile = plan.at(x, y);
      const double eye = plan.ground_height_m + 1.2;
      if (profile == nullptr || profile->outside || profile->reaches_into(eye - 0.1, eye + 0.1)) {
        continue;
      }
      const PanoramaRequest request{{x, y, 0.0}, eye, {}, {}};
      const Panorama panorama = render_panorama(columns, request);
      EXPECT_EQ(render_column_view(columns, request, false),
                ColumnView::from_labels(panorama.labels));
      compare(panorama, render_panorama(scene, request), difference);
      ++views;
    }
    EXPECT_LE(difference.labels, 2 + difference.pixels / 1'000'000) << name;
    EXPECT_EQ(difference.ranges, 0) << name;
  }
}

}  // namespace
}  // namespace semview::raycast
