// SPDX-License-Identifier: Apache-2.0
// The walk in lanes against the walk ray by ray, on every target of this machine.
#include "semview/raycast/column_walk.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "raycast/small_worlds.hpp"
#include "semview/raycast/column_camera.hpp"
#include "support/only_target.hpp"

namespace semview::raycast {
namespace {

/// Eyes on the plan and past it, some on pixel edges; any yaw, or none; any affine, or none.
PanoramaRequest random_request(Rng& rng, const map::ColumnMap& plan) {
  double u_m = rng.uniform(-3.0, plan.columns() * plan.resolution_m + 3.0);
  double v_m = rng.uniform(-3.0, plan.rows() * plan.resolution_m + 3.0);
  if (rng.below(3) == 0) u_m = std::round(u_m / plan.resolution_m) * plan.resolution_m;
  if (rng.below(3) == 0) v_m = std::round(v_m / plan.resolution_m) * plan.resolution_m;
  const Eigen::Vector2d eye = plan.map_from_plan(u_m, v_m);
  PanoramaRequest request;
  request.map_from_robot = {eye.x(), eye.y(), rng.below(3) == 0 ? 0.0 : rng.uniform(-3.0, 3.0)};
  request.eye_z_m = rng.uniform(-1.0, 4.0);
  request.camera.columns = 1 + static_cast<int>(rng.below(150));
  if (rng.below(2) == 0)
    request.affine = {rng.uniform(0.2, 5.0), rng.uniform(0.2, 5.0), rng.uniform(-2.0, 2.0)};
  return request;
}

TEST(ColumnWalkTest, EveryTargetWalksAsTheScalarTwin) {
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  ASSERT_FALSE(targets.empty());
  Rng rng(1, "walk");
  for (int i = 0; i < 60; ++i) {
    map::ColumnMap plan =
        random_plan(rng, 3 + static_cast<int>(rng.below(60)), 3 + static_cast<int>(rng.below(60)));
    if (i % 3 == 0) plan.origin.yaw_rad = 0.0;
    const ColumnScene scene = ColumnScene::build(plan);
    const PanoramaRequest request = random_request(rng, plan);
    ColumnRays rays;
    ColumnCamera(request.camera).aim(scene, request, rays);
    Crossings singly;
    walk_columns_singly(scene.grid(), rays, singly);
    for (const std::int64_t target : targets) {
      const OnlyTarget only(target);
      Crossings lanes;
      walk_columns(scene.grid(), rays, lanes);
      for (std::size_t ray = 0; ray < rays.count; ++ray) {
        ASSERT_TRUE(std::ranges::equal(lanes.of(ray), singly.of(ray)))
            << hwy::TargetName(target) << " plan " << i << " ray " << ray;
      }
    }
  }
}

}  // namespace
}  // namespace semview::raycast
