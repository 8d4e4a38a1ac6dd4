// SPDX-License-Identifier: Apache-2.0
// Views that caches out there may hold. If this fails because views are meant to change, raise
// the engine's version, so that no cache serves the old ones, and only then put the new hash here.
#include <gtest/gtest.h>

#include "raycast/small_worlds.hpp"
#include "semview/core/hash.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/raycast/embree_engine.hpp"

namespace semview::raycast {
namespace {

TEST(GoldenViewsTest, TheEnginesViewsAreThoseOfItsVersion) {
  Rng rng(2026, "golden");
  Hasher hasher;
  for (int plan = 0; plan < 4; ++plan) {
    const map::ColumnMap drawn = random_plan(rng, 13, 17);
    const auto scene = Scene::build(map::extrude(drawn));
    const Eigen::Vector2d eye = drawn.pixel_center({6, 8});
    const PanoramaRequest request{{eye.x() + 0.013, eye.y() - 0.017, 0.0}, 1.2, {}, {}};
    const ColumnView view = render_column_view(*scene, request);
    for (const semview::Run& run : view.runs()) {
      hasher.add_u32(run.end_row);
      hasher.add_u32(run.label);
    }
  }
  EXPECT_EQ(EmbreeEngine::kVersion, 1U);
  EXPECT_EQ(to_hex(hasher.digest()), "20b7d4e3ed7aa1940f7072e5979a303a");
}

}  // namespace
}  // namespace semview::raycast
