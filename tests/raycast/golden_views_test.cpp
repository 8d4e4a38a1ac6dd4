// SPDX-License-Identifier: Apache-2.0
// Views that caches out there may hold. If this fails because views are meant to change, raise
// the engine's version, so that no cache serves the old ones, and only then put the new hash here.
#include <bit>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "raycast/small_worlds.hpp"
#include "semview/core/hash.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/raycast/columns_engine.hpp"
#include "semview/raycast/embree_engine.hpp"

namespace semview::raycast {
namespace {

/// Hashes what an engine sees of a few random plans.
template <typename EngineOf>
std::string digest_of_views(const EngineOf& engine_of, bool ranges) {
  Rng rng(2026, "golden");
  Hasher hasher;
  for (int plan = 0; plan < 4; ++plan) {
    const map::ColumnMap drawn = random_plan(rng, 13, 17);
    const Eigen::Vector2d eye = drawn.pixel_center({6, 8});
    const PanoramaRequest request{{eye.x() + 0.013, eye.y() - 0.017, 0.0}, 1.2, {}, {}};
    const ColumnView view = engine_of(drawn).column_view(request, ranges);
    for (const semview::Run& run : view.runs()) {
      hasher.add_u32(run.end_row);
      hasher.add_u32(run.label);
    }
    for (const RunPlane& plane : view.planes()) {
      hasher.add_u32(std::bit_cast<std::uint32_t>(plane.a_per_m));
      hasher.add_u32(std::bit_cast<std::uint32_t>(plane.b_per_m));
    }
  }
  return to_hex(hasher.digest());
}

TEST(GoldenViewsTest, EmbreesViewsAreThoseOfItsVersion) {
  const auto engine_of = [](const map::ColumnMap& plan) {
    return EmbreeEngine(std::make_shared<const Scene>(*Scene::build(map::extrude(plan))));
  };
  EXPECT_EQ(EmbreeEngine::kVersion, 1U);
  EXPECT_EQ(digest_of_views(engine_of, false), "20b7d4e3ed7aa1940f7072e5979a303a");
  EXPECT_EQ(digest_of_views(engine_of, true), "b1ca8bf97fd2c64e6394862136958571");
}

TEST(GoldenViewsTest, ColumnsViewsAreThoseOfTheirVersion) {
  const auto engine_of = [](const map::ColumnMap& plan) {
    return ColumnsEngine(std::make_shared<const ColumnScene>(ColumnScene::build(plan)));
  };
  EXPECT_EQ(ColumnsEngine::kVersion, 1U);
  EXPECT_EQ(digest_of_views(engine_of, false), "20b7d4e3ed7aa1940f7072e5979a303a");
  EXPECT_EQ(digest_of_views(engine_of, true), "9113e3ed473a82d2ad55630404eccf09");
}

}  // namespace
}  // namespace semview::raycast
