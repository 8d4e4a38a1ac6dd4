// SPDX-License-Identifier: Apache-2.0
// Fused from depths rendered of a known room: how far is the surface from the truth?
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "semview/core/random.hpp"
#include "semview/field/floor_height.hpp"
#include "semview/field/fusion.hpp"
#include "semview/field/volume_mesh.hpp"
#include "semview/raycast/pinhole_renderer.hpp"

namespace semview::field {
namespace {

constexpr ClassId kFloor = 1;
constexpr ClassId kWall = 2;
constexpr ClassId kTable = 3;
constexpr ClassId kCabinet = 4;

/// Both sides are seen: a ray does not ask which way a triangle faces.
void add_box(map::TriangleMesh& mesh,
             const Eigen::Vector3f& low,
             const Eigen::Vector3f& high,
             ClassId sides,
             ClassId bottom) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int corner = 0; corner < 8; ++corner) {
    mesh.vertices.emplace_back((corner & 1) != 0 ? high.x() : low.x(),
                               (corner & 2) != 0 ? high.y() : low.y(),
                               (corner & 4) != 0 ? high.z() : low.z());
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  for (std::size_t face = 0; face < kFaces.size(); ++face) {
    const auto& [a, b, c, d] = kFaces[face];
    mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.triangles.push_back({first + a, first + c, first + d});
    mesh.labels.insert(mesh.labels.end(), 2, face == 0 ? bottom : sides);
  }
}

/// 5 m × 4 m × 2.5 m, a table on its slab alone and a cabinet.
map::TriangleMesh room() {
  map::TriangleMesh mesh;
  add_box(mesh, {-2.52F, -2.03F, 0.01F}, {2.48F, 1.97F, 2.51F}, kWall, kFloor);
  add_box(mesh, {0.3F, -0.4F, 0.68F}, {1.5F, 0.4F, 0.74F}, kTable, kTable);
  add_box(mesh, {-2.5F, 1.2F, 0.0F}, {-1.5F, 1.97F, 1.0F}, kCabinet, kCabinet);
  return mesh;
}

float distance_to_triangle(const Eigen::Vector3f& point,
                           const Eigen::Vector3f& a,
                           const Eigen::Vector3f& b,
                           const Eigen::Vector3f& c) {
  const Eigen::Vector3f normal = (b - a).cross(c - a);
  bool inside = true;
  float nearest = std::numeric_limits<float>::infinity();
  const std::array<Eigen::Vector3f, 3> corners{a, b, c};
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3f from = corners[i];
    const Eigen::Vector3f edge = corners[(i + 1) % 3] - from;
    inside = inside && normal.dot(edge.cross(point - from)) >= 0.0F;
    const float along = std::clamp(edge.dot(point - from) / edge.squaredNorm(), 0.0F, 1.0F);
    nearest = std::min(nearest, (point - from - along * edge).norm());
  }
  return inside ? std::abs(normal.normalized().dot(point - a)) : nearest;
}

struct Nearest {
  float distance_m = std::numeric_limits<float>::infinity();
  ClassId label = kNoHit;
};

Nearest nearest_of(const map::TriangleMesh& mesh, const Eigen::Vector3f& point) {
  Nearest nearest;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const float distance_m =
        distance_to_triangle(point, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
    if (distance_m < nearest.distance_m) nearest = {distance_m, mesh.labels[t]};
  }
  return nearest;
}

/// From three places all round, level and looking down.
std::vector<Eigen::Isometry3d> path() {
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 48; ++i) {
    const double side = static_cast<double>(i % 3) - 1.0;
    Eigen::Isometry3d pose = level_camera({1.4 * side, 0.9 * side * side - 0.5, 0.39 * i}, 1.3);
    if (i % 2 == 1) pose.rotate(Eigen::AngleAxisd(-0.4, Eigen::Vector3d::UnitX()));
    poses.push_back(pose);
  }
  return poses;
}

struct Fused {
  map::TriangleMesh mesh;
  std::vector<Eigen::Vector3f> seen;  ///< some of the points that the frames saw
};

/// @param error  of position (m) and of each angle (rad), one standard deviation
Fused fuse_room(const map::TriangleMesh& truth, double position_m, double angle_rad) {
  const auto scene = raycast::Scene::build(truth).value();
  ThreadPool pool(2);
  Rng rng(7, "poses");
  SemanticVolume volume(VolumeShape{}, ClassTable({"floor", "wall", "table", "cabinet"}));
  Fused fused;
  for (const Eigen::Isometry3d& pose : path()) {
    const PinholeCamera camera{160, 120, 130.0, 130.0, 80.0, 60.0};
    const raycast::PinholeView view = raycast::render_pinhole(scene, {pose, camera});
    Eigen::Isometry3d estimated = pose;
    const auto draw = [&rng](double sigma) {
      Eigen::Vector3d error;
      for (double& number : error) number = rng.normal(0.0, sigma);
      return error;
    };
    estimated.pretranslate(draw(position_m));
    const Eigen::Vector3d turn = draw(angle_rad);
    if (turn.norm() > 0.0) estimated.rotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
    const auto done = fuse({view.depths_m, view.labels, {}, camera, estimated}, {}, pool, volume);
    EXPECT_TRUE(done) << done.error().message;
    for (int r = 5; r < camera.rows; r += 37) {
      for (int c = 3; c < camera.columns; c += 31) {
        const double depth_m = static_cast<double>(view.depths_m.at(r, c));
        const Eigen::Vector3d point = pose * Eigen::Vector3d(depth_m * camera.direction(r, c));
        if (depth_m < FusionConfig{}.max_depth_m) fused.seen.push_back(point.cast<float>());
      }
    }
  }
  fused.mesh = mesh_of(volume, {}, pool).value();
  return fused;
}

struct Agreement {
  std::vector<float> errors_m;  ///< of the triangles' centres, rising
  double of_class = 0.0;        ///< share of the triangles with the class of the nearest true one
  double seen = 0.0;            ///< share of the points seen that have a vertex within a voxel

  float error_m(double share) const {
    return errors_m[static_cast<std::size_t>(share * static_cast<double>(errors_m.size() - 1))];
  }
};

Agreement compare(const Fused& fused, const map::TriangleMesh& truth) {
  Agreement agreement;
  std::size_t same = 0;
  for (std::size_t t = 0; t < fused.mesh.triangles.size(); t += 3) {  // enough of them
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();
    for (const std::uint32_t v : fused.mesh.triangles[t]) centre += fused.mesh.vertices[v] / 3.0F;
    const Nearest nearest = nearest_of(truth, centre);
    agreement.errors_m.push_back(nearest.distance_m);
    if (nearest.label == fused.mesh.labels[t]) ++same;
  }
  std::ranges::sort(agreement.errors_m);
  agreement.of_class = static_cast<double>(same) / static_cast<double>(agreement.errors_m.size());
  std::size_t found = 0;
  for (const Eigen::Vector3f& point : fused.seen) {
    const auto near = [&](const Eigen::Vector3f& v) { return (v - point).norm() < 0.05F; };
    if (std::ranges::any_of(fused.mesh.vertices, near)) ++found;
  }
  agreement.seen = static_cast<double>(found) / static_cast<double>(fused.seen.size());
  return agreement;
}

TEST(FusionTruthTest, OfExactDepthsTheSurfaceAndItsClassesAreThoseOfTheRoom) {
  const map::TriangleMesh truth = room();
  const Fused fused = fuse_room(truth, 0.0, 0.0);
  const Agreement agreement = compare(fused, truth);
  EXPECT_LT(agreement.error_m(0.5), 0.003F);
  EXPECT_LT(agreement.error_m(0.95), 0.02F);
  EXPECT_LT(agreement.error_m(0.99), 0.05F);
  EXPECT_GT(agreement.of_class, 0.96);
  EXPECT_GT(agreement.seen, 0.98);
  EXPECT_NEAR(floor_height_m(fused.mesh, kFloor, 0.05), 0.01, 0.005);
}

TEST(FusionTruthTest, PosesOffByACentimetreMoveTheSurfaceLessThanAVoxel) {
  const map::TriangleMesh truth = room();
  const Agreement agreement = compare(fuse_room(truth, 0.01, 0.005), truth);
  EXPECT_LT(agreement.error_m(0.5), 0.01F);
  EXPECT_LT(agreement.error_m(0.99), 0.05F);
  EXPECT_GT(agreement.of_class, 0.95);
}

}  // namespace
}  // namespace semview::field
