// SPDX-License-Identifier: Apache-2.0
// Views of extruded plans.
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "raycast/small_worlds.hpp"
#include "reference/brute_force_caster.hpp"
#include "reference/point_projection.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/raycast/panorama_renderer.hpp"

namespace semview::raycast {
namespace {

constexpr double kEye_m = 1.2;

Scene extruded(const map::ColumnMap& plan, bool robust = true) {
  return std::move(*Scene::build(map::extrude(plan), {robust}));
}

/// A random pose over a free pixel, well inside it.
Pose2 free_pose(Rng& rng, const map::ColumnMap& plan) {
  for (;;) {
    const double u = rng.uniform(0.0, plan.columns() * plan.resolution_m);
    const double v = rng.uniform(0.0, plan.rows() * plan.resolution_m);
    const Eigen::Vector2d xy = plan.map_from_plan(u, v);
    const ColumnProfile* profile = plan.at(xy.x(), xy.y());
    if (profile != nullptr && !profile->outside && profile->slabs.empty()) {
      return {xy.x(), xy.y(), rng.uniform(-3.1, 3.1)};
    }
  }
}

/// The plan without any cleverness: twelve triangles round every slab of every pixel, ground and
/// ceiling under and over each.
map::TriangleMesh box_per_pixel(const map::ColumnMap& plan) {
  map::TriangleMesh mesh;
  const auto corner = [&](double u, double v, double z) {
    const Eigen::Vector2d xy = plan.map_from_plan(u, v);
    return Eigen::Vector3d(xy.x(), xy.y(), z).cast<float>().eval();
  };
  for (int r = 0; r < plan.rows(); ++r) {
    for (int c = 0; c < plan.columns(); ++c) {
      const ColumnProfile& profile = plan.profile(r, c);
      if (profile.outside) continue;
      const double u = c * plan.resolution_m, v = (plan.rows() - 1 - r) * plan.resolution_m;
      const double u1 = u + plan.resolution_m, v1 = v + plan.resolution_m;
      const auto level = [&](double z, ClassId label) {
        add_quad(
            mesh, {corner(u, v, z), corner(u1, v, z), corner(u1, v1, z), corner(u, v1, z)}, label);
      };
      const bool on_ground =
          !profile.slabs.empty() && profile.slabs.front().z_min_m <= plan.ground_height_m;
      if (!on_ground) level(plan.ground_height_m, profile.ground);
      if (profile.slabs.empty() || profile.slabs.back().z_max_m < plan.ceiling->height_m) {
        level(plan.ceiling->height_m, plan.ceiling->label);
      }
      for (const Slab& slab : profile.slabs) {
        const double z = slab.z_min_m, z1 = slab.z_max_m;
        level(z, slab.label);
        level(z1, slab.label);
        const auto side = [&](double ua, double va, double ub, double vb) {
          add_quad(mesh,
                   {corner(ua, va, z), corner(ub, vb, z), corner(ub, vb, z1), corner(ua, va, z1)},
                   slab.label);
        };
        side(u, v, u1, v);
        side(u1, v, u1, v1);
        side(u1, v1, u, v1);
        side(u, v1, u, v);
      }
    }
  }
  return mesh;
}

TEST(PlanTest, RandomPlansLookAsBoxesTestedOneByOne) {
  int pixels = 0;
  int different = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Rng rng(seed, "plan");
    const map::ColumnMap plan = random_plan(rng, 9, 11);
    const map::TriangleMesh boxes = box_per_pixel(plan);
    const PanoramaRequest request{free_pose(rng, plan), kEye_m, {72, 36, -1.2, 1.2}, {}};
    const Panorama panorama = render_panorama(extruded(plan), request);
    const Eigen::Vector3d eye(request.map_from_robot.x_m, request.map_from_robot.y_m, kEye_m);
    const Eigen::AngleAxisd yaw(request.map_from_robot.yaw_rad, Eigen::Vector3d::UnitZ());
    for (int r = 0; r < request.camera.rows; ++r) {
      for (int c = 0; c < request.camera.columns; ++c) {
        const auto truth =
            reference::brute_force_cast(boxes, eye, yaw * request.camera.direction(r, c));
        ++pixels;
        const bool same =
            panorama.labels.at(r, c) == truth.label &&
            std::abs(static_cast<double>(panorama.ranges_m.at(r, c)) - truth.parameter) < 1e-4;
        different += same ? 0 : 1;
      }
    }
  }
  // A ray that passes an edge within rounding may see either side of it.
  EXPECT_LE(different, 1) << "of " << pixels;
}

TEST(PlanTest, NoRayLeavesAClosedPlan) {
  for (const bool robust : {true, false}) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      Rng rng(seed, "leaks");
      const map::ColumnMap plan = random_plan(rng, 25, 31);
      const Scene scene = extruded(plan, robust);
      for (int i = 0; i < 4; ++i) {
        const PanoramaRequest request{
            free_pose(rng, plan), kEye_m, {360, 180, -kPi / 2.0, kPi / 2.0}, {}};
        const Panorama panorama = render_panorama(scene, request);
        ASSERT_EQ(std::ranges::count(panorama.labels.pixels(), kNoHit), 0) << "seed " << seed;
        for (const float range_m : panorama.ranges_m.pixels()) {
          ASSERT_TRUE(range_m >= 0.0F && range_m < 30.0F) << range_m;
        }
      }
    }
  }
}

TEST(PlanTest, PacketsAreSingleRays) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed, "packets");
    const map::ColumnMap plan = random_plan(rng, 25, 31);
    const Scene scene = extruded(plan);
    const PanoramaRequest request{free_pose(rng, plan), kEye_m, {}, {}};
    const Panorama packets = render_panorama(scene, request);
    const Panorama singles = render_panorama_single_rays(scene, request);
    EXPECT_EQ(packets.labels, singles.labels) << "seed " << seed;
    for (std::size_t i = 0; i < packets.ranges_m.pixels().size(); ++i) {
      const float a = packets.ranges_m.pixels()[i];
      ASSERT_NEAR(a, singles.ranges_m.pixels()[i], 1e-5F * (1.0F + a));
    }
  }
}

TEST(PlanTest, TurningByAHeadingShiftsTheColumns) {
  Rng plan_rng(1, "equivariance");
  const map::ColumnMap plan = random_plan(plan_rng, 25, 31);
  const Scene scene = extruded(plan);
  EXPECT_TRUE(rc::check("panorama(yaw + 3° k)[c] == panorama(yaw)[c - k W / 120]", [&] {
    Rng rng(*rc::gen::arbitrary<std::uint64_t>(), "pose");
    const int heading = *rc::gen::inRange(0, PoseGrid::kHeadings);
    const int columns = 120 * *rc::gen::inRange(1, 5);
    const Pose2 pose = free_pose(rng, plan);
    const Pose2 turned{
        pose.x_m, pose.y_m, wrap_angle(pose.yaw_rad + PoseGrid::heading_yaw_rad(heading))};
    const PanoramaCamera camera{columns, 30, -kPi / 4.0, kPi / 4.0};
    const LabelImage ahead = render_panorama(scene, {pose, kEye_m, camera, {}}).labels;
    const LabelImage shifted = ColumnView::from_labels(ahead).to_labels(heading);
    const LabelImage cast = render_panorama(scene, {turned, kEye_m, camera, {}}).labels;
    // The two angles differ by a rounding error of double: next to never does a pixel notice.
    int different = 0;
    for (std::size_t i = 0; i < cast.pixels().size(); ++i) {
      different += cast.pixels()[i] == shifted.pixels()[i] ? 0 : 1;
    }
    RC_ASSERT(different <= 1);
  }));
}

TEST(PlanTest, AnAffineViewIsTheViewOfTheStraightenedPlan) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng(seed, "affine");
    const map::ColumnMap plan = random_plan(rng, 15, 17);
    const MapAffine affine{rng.uniform(0.7, 1.4), rng.uniform(0.7, 1.4), rng.uniform(-0.4, 0.4)};
    const Pose2 drawn_pose = free_pose(rng, plan);
    // True metres = A⁻¹ · drawn metres, for every corner of the mesh and for the eye.
    const auto straighten = [&](double x, double y) {
      return Eigen::Vector2d(x / affine.a, (y - affine.k * x / affine.a) / affine.b);
    };
    map::TriangleMesh mesh = map::extrude(plan);
    const Scene drawn = std::move(*Scene::build(mesh));
    for (Eigen::Vector3f& vertex : mesh.vertices) {
      const Eigen::Vector2d xy =
          straighten(static_cast<double>(vertex.x()), static_cast<double>(vertex.y()));
      vertex.head<2>() = xy.cast<float>();
    }
    const Eigen::Vector2d true_eye = straighten(drawn_pose.x_m, drawn_pose.y_m);
    const Pose2 true_pose{true_eye.x(), true_eye.y(), drawn_pose.yaw_rad};
    const Panorama through = render_panorama(drawn, {drawn_pose, kEye_m, {}, affine});
    const Panorama truth = render_panorama(*Scene::build(mesh), {true_pose, kEye_m, {}, {}});
    int different = 0;
    for (std::size_t i = 0; i < truth.labels.pixels().size(); ++i) {
      const bool same = through.labels.pixels()[i] == truth.labels.pixels()[i] &&
                        std::abs(through.ranges_m.pixels()[i] - truth.ranges_m.pixels()[i]) < 1e-3F;
      different += same ? 0 : 1;
    }
    // Rounding the straightened corners to float moves edges by a few 1e-7 m.
    EXPECT_LE(different, 5) << "seed " << seed;
  }
}

struct Agreement {
  double same = 0.0;         // share of pixels with one class in both
  double unexplained = 0.0;  // share of pixels whose projected class no neighbour has when cast
};

Agreement compare(const LabelImage& projected, const LabelImage& cast) {
  Agreement result;
  for (int r = 0; r < cast.rows(); ++r) {
    for (int c = 0; c < cast.columns(); ++c) {
      bool near = false;
      for (int i = 0; i < 9; ++i) {
        const int row = std::clamp(r + i / 3 - 1, 0, cast.rows() - 1);
        const int column = (c + i % 3 - 1 + cast.columns()) % cast.columns();
        near = near || cast.at(row, column) == projected.at(r, c);
      }
      result.same += cast.at(r, c) == projected.at(r, c) ? 1.0 : 0.0;
      result.unexplained += near ? 0.0 : 1.0;
    }
  }
  const auto pixels = static_cast<double>(cast.pixels().size());
  return {result.same / pixels, result.unexplained / pixels};
}

TEST(PlanTest, ThePointProjectionOfThePaperAgreesExceptAtEdges) {
  Rng rng(7, "points");
  map::ColumnMap plan = random_plan(rng, 9, 11);
  // The eye stands in a clear square: near the eye a point cloud has holes.
  for (int r = 3; r <= 5; ++r) {
    for (int c = 4; c <= 6; ++c) plan.profile_of_pixel.at(r, c) = 1;
  }
  const Eigen::Vector2d middle = plan.pixel_center({4, 5});
  const PanoramaRequest request{
      {middle.x() + 0.03, middle.y() - 0.04, 0.4}, kEye_m, {120, 30, -kPi / 4.0, kPi / 4.0}, {}};
  const LabelImage cast = render_panorama(extruded(plan), request).labels;
  const auto agreement = [&](double spacing_m) {
    return compare(reference::project_points(reference::point_cloud(plan, spacing_m),
                                             request.map_from_robot,
                                             request.eye_z_m,
                                             request.camera),
                   cast);
  };
  const Agreement coarse = agreement(0.1);
  const Agreement fine = agreement(0.02);
  RecordProperty("same_at_0.1_m", std::to_string(coarse.same));
  RecordProperty("same_at_0.02_m", std::to_string(fine.same));
  // Coarse points leave holes and let one see through walls.
  EXPECT_LT(coarse.same, fine.same);
  // Dense ones differ where an edge crosses a pixel: the projection keeps the nearest surface
  // anywhere in the pixel, ray casting the one at its centre. So nearer things look half a pixel
  // larger, and nothing else differs.
  EXPECT_GT(fine.same, 0.95);
  EXPECT_LT(fine.unexplained, 0.002);
}

}  // namespace
}  // namespace semview::raycast
