// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "raycast/small_worlds.hpp"
#include "reference/brute_force_caster.hpp"
#include "semview/geometry/pinhole_camera.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/raycast/pinhole_renderer.hpp"

namespace semview::raycast {
namespace {

using reference::brute_force_cast;

/// True if a direction next to the pixel's (2e-6 rad off, a few steps of float) has this answer:
/// the ray passes so near to an edge that float rounding decides.
bool on_an_edge(const map::TriangleMesh& mesh,
                const Eigen::Vector3d& eye,
                const Eigen::Vector3d& direction,
                ClassId label,
                double parameter) {
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3d off(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const auto hit = brute_force_cast(mesh, eye + 1e-6 * off, direction + 2e-6 * off);
    if (hit.label == label &&
        (std::isinf(parameter) ? std::isinf(hit.parameter)
                               : std::abs(hit.parameter - parameter) < 1e-3)) {
      return true;
    }
  }
  return false;
}

struct Comparison {
  int pixels = 0;
  int on_edges = 0;
  int wrong = 0;
};

Comparison compare(const map::TriangleMesh& mesh, const PanoramaRequest& request) {
  const auto scene = Scene::build(mesh);
  const Panorama panorama = render_panorama(*scene, request);
  const Eigen::Vector3d eye(
      request.map_from_robot.x_m, request.map_from_robot.y_m, request.eye_z_m);
  const Eigen::AngleAxisd yaw(request.map_from_robot.yaw_rad, Eigen::Vector3d::UnitZ());
  Comparison result;
  for (int r = 0; r < request.camera.rows; ++r) {
    for (int c = 0; c < request.camera.columns; ++c) {
      const Eigen::Vector3d direction = request.affine.apply(yaw * request.camera.direction(r, c));
      const auto truth = brute_force_cast(mesh, eye, direction);
      const ClassId label = panorama.labels.at(r, c);
      const auto range_m = static_cast<double>(panorama.ranges_m.at(r, c));
      ++result.pixels;
      const bool same_range = std::isinf(truth.parameter) ? std::isinf(range_m)
                                                          : std::abs(range_m - truth.parameter) <
                                                                2e-5 * (1 + truth.parameter);
      if (label == truth.label && same_range) continue;
      if (on_an_edge(mesh, eye, direction, label, range_m)) {
        ++result.on_edges;
      } else {
        ++result.wrong;
      }
    }
  }
  return result;
}

TEST(BruteForceTest, RandomMeshesLookAsEveryTriangleTestedOneByOne) {
  Comparison total;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed, "mesh");
    const map::TriangleMesh mesh = random_mesh(rng, 60);
    const PanoramaRequest request{{rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-3, 3)},
                                  rng.uniform(-1, 1),
                                  {90, 45, -1.4, 1.4},
                                  {rng.uniform(0.5, 2), rng.uniform(0.5, 2), rng.uniform(-1, 1)}};
    const Comparison one = compare(mesh, request);
    EXPECT_EQ(one.wrong, 0) << "seed " << seed;
    total.on_edges += one.on_edges;
    total.pixels += one.pixels;
  }
  EXPECT_LT(total.on_edges, total.pixels / 1000);
}

TEST(BruteForceTest, PinholeViewsOfRandomMeshesAgreeToo) {
  int on_edges = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng(seed, "pinhole");
    const map::TriangleMesh mesh = random_mesh(rng, 60);
    PinholeRequest request{Eigen::Isometry3d::Identity(), {61, 47, 40.0, 42.0, 31.0, 22.0}};
    request.map_from_camera.linear() =
        Eigen::Quaterniond(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1), 0.5)
            .normalized()
            .toRotationMatrix();
    request.map_from_camera.translation() << rng.uniform(-2, 2), rng.uniform(-2, 2), 0.1;
    ASSERT_TRUE(validate(request));
    const PinholeView view = render_pinhole(*Scene::build(mesh), request);
    for (int r = 0; r < request.camera.rows; ++r) {
      for (int c = 0; c < request.camera.columns; ++c) {
        const Eigen::Vector3d eye = request.map_from_camera.translation();
        const Eigen::Vector3d direction =
            request.map_from_camera.linear() * request.camera.direction(r, c);
        const auto truth = brute_force_cast(mesh, eye, direction);
        const auto depth_m = static_cast<double>(view.depths_m.at(r, c));
        if (view.labels.at(r, c) == truth.label &&
            (std::isinf(truth.parameter) || std::abs(depth_m - truth.parameter) < 1e-4)) {
          continue;
        }
        ASSERT_TRUE(on_an_edge(mesh, eye, direction, view.labels.at(r, c), depth_m));
        ++on_edges;
      }
    }
  }
  EXPECT_LT(on_edges, 30);
}

TEST(BruteForceTest, PacketsAreSingleRays) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed, "packets");
    const auto scene = Scene::build(random_mesh(rng, 400));
    const PanoramaRequest request{{rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-3, 3)},
                                  rng.uniform(-1, 1),
                                  {361, 91, -1.5, 1.5},
                                  {}};
    const Panorama packets = render_panorama(*scene, request);
    const Panorama singles = render_panorama_single_rays(*scene, request);
    EXPECT_EQ(packets.labels, singles.labels) << "seed " << seed;
    for (std::size_t i = 0; i < packets.ranges_m.pixels().size(); ++i) {
      const float a = packets.ranges_m.pixels()[i];
      const float b = singles.ranges_m.pixels()[i];
      ASSERT_TRUE(a == b || std::abs(a - b) <= 1e-5F * a) << a << " and " << b;
    }
  }
}

TEST(BruteForceTest, APinholeImageIsItsPixelsOneByOne) {
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    Rng rng(seed, "pixels");
    const auto scene = Scene::build(random_mesh(rng, 400));
    const Pose2 pose{rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-3, 3)};
    const PinholeRequest whole{level_camera(pose, 0.1), {131, 67, 90, 90, 65, 30}};
    const LabelImage labels = render_pinhole(*scene, whole).labels;
    for (int r = 0; r < labels.rows(); ++r) {
      for (int c = 0; c < labels.columns(); ++c) {
        PinholeRequest one = whole;
        one.camera.columns = one.camera.rows = 1;
        one.camera.cx_px -= c;
        one.camera.cy_px -= r;
        ASSERT_EQ(labels.at(r, c), render_pinhole(*scene, one).labels.at(0, 0)) << r << ", " << c;
      }
    }
  }
}

}  // namespace
}  // namespace semview::raycast
