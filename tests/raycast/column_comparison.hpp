// SPDX-License-Identifier: Apache-2.0
/// The columns caster against Embree on the extruded plan, pixel by pixel.
#pragma once

#include <algorithm>
#include <cmath>
#include <ostream>

#include <Eigen/Core>

#include "raycast/small_worlds.hpp"
#include "reference/brute_force_caster.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/raycast/column_renderer.hpp"
#include "semview/raycast/panorama_renderer.hpp"

namespace semview::raycast {

struct ColumnComparison {
  std::int64_t pixels = 0;
  std::int64_t ties = 0;   // differ, and the pixel's ray passes an edge within rounding
  std::int64_t wrong = 0;  // differ without an edge there
  double worst_range_m = 0.0;
};

inline std::ostream& operator<<(std::ostream& out, const ColumnComparison& comparison) {
  return out << comparison.ties << " ties and " << comparison.wrong << " wrong of "
             << comparison.pixels << " pixels";
}

/// True if rays within a few steps of float around this one do not all see one class at about one
/// range; in doubles, triangle by triangle, without either caster.
inline bool passes_an_edge(const map::TriangleMesh& mesh,
                           const Eigen::Vector3d& eye,
                           const Eigen::Vector3d& direction) {
  const auto seen = reference::brute_force_cast(mesh, eye, direction);
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3d off(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const auto near = reference::brute_force_cast(mesh, eye + 4e-6 * off, direction + 2e-6 * off);
    if (near.label != seen.label) return true;
    if (std::isfinite(seen.parameter) && std::abs(near.parameter - seen.parameter) > 2e-3) {
      return true;
    }
  }
  return false;
}

/// Casts one view by both and adds to the comparison. Ranges must agree within a centimetre.
inline void compare_casters(const map::TriangleMesh& mesh,
                            const Scene& scene,
                            const ColumnScene& columns,
                            const PanoramaRequest& request,
                            ColumnComparison& comparison) {
  const Panorama seen = render_panorama(columns, request);
  const Panorama truth = render_panorama(scene, request);
  const Pose2& pose = request.map_from_robot;
  const Eigen::Vector3d eye(pose.x_m, pose.y_m, request.eye_z_m);
  const Eigen::AngleAxisd yaw(pose.yaw_rad, Eigen::Vector3d::UnitZ());
  for (int r = 0; r < truth.labels.rows(); ++r) {
    for (int c = 0; c < truth.labels.columns(); ++c) {
      ++comparison.pixels;
      const double range_m = seen.ranges_m.at(r, c);
      const double true_range_m = truth.ranges_m.at(r, c);
      const double off_m = range_m == true_range_m ? 0.0 : std::abs(range_m - true_range_m);
      if (seen.labels.at(r, c) == truth.labels.at(r, c) && off_m <= 0.01) {
        comparison.worst_range_m = std::max(comparison.worst_range_m, off_m);
        continue;
      }
      const Eigen::Vector3d direction = request.affine.apply(yaw * request.camera.direction(r, c));
      ++(passes_an_edge(mesh, eye, direction) ? comparison.ties : comparison.wrong);
    }
  }
}

/// Any plan: up to four slabs a profile, touching or with gaps between, under a ceiling or an open
/// top, pixels outside in the middle, grounds of several classes, any origin.
inline map::ColumnMap any_plan(Rng& rng) {
  map::ColumnMap plan;
  plan.resolution_m = rng.below(2) == 0 ? 0.5 : 0.05;
  plan.origin = {rng.uniform(-9.0, 9.0), rng.uniform(-9.0, 9.0), rng.uniform(-3.1, 3.1)};
  if (rng.below(2) == 0) plan.origin.yaw_rad = 0.0;
  plan.ground_height_m = rng.uniform(-1.0, 1.0);
  const double top_m = plan.ground_height_m + 2.6;
  if (rng.below(3) != 0) plan.ceiling = map::Ceiling{kPlanCeiling, top_m};
  plan.profiles.push_back(ColumnProfile{true, false, kNoHit, {}});
  const auto any_class = [&rng] { return static_cast<ClassId>(3 + rng.below(6)); };
  while (plan.profiles.size() < 10) {
    ColumnProfile profile{false, false, rng.below(3) == 0 ? any_class() : kPlanFloor, {}};
    double height_m = plan.ground_height_m;
    for (std::uint64_t slabs = rng.below(5); slabs > 0 && height_m < top_m - 0.2; --slabs) {
      if (rng.below(2) == 0) height_m = rng.uniform(height_m, top_m - 0.1);
      const double end_m = rng.below(3) == 0 ? top_m : rng.uniform(height_m + 0.01, top_m);
      profile.slabs.push_back({height_m, end_m, any_class()});
      height_m = end_m;
    }
    plan.profiles.push_back(profile);
  }
  plan.profiles[1] = ColumnProfile{false, false, kPlanFloor, {}};
  plan.profiles[2] = {false, false, kPlanFloor, {{plan.ground_height_m, top_m, kPlanWall}}};
  const int rows = 3 + static_cast<int>(rng.below(40));
  const int columns = 3 + static_cast<int>(rng.below(40));
  plan.profile_of_pixel = Image<std::uint8_t>(rows, columns, 1);
  // Boxes and single pixels over free floor, so that there is something to leap over.
  for (std::uint64_t boxes = rng.below(60); boxes > 0; --boxes) {
    const auto profile = static_cast<std::uint8_t>(rng.below(plan.profiles.size()));
    const int top = static_cast<int>(rng.below(static_cast<std::uint64_t>(rows)));
    const int left = static_cast<int>(rng.below(static_cast<std::uint64_t>(columns)));
    const int size = rng.below(2) == 0 ? 1 : 1 + static_cast<int>(rng.below(8));
    for (int r = top; r < std::min(rows, top + size); ++r) {
      for (int c = left; c < std::min(columns, left + size); ++c) {
        plan.profile_of_pixel.at(r, c) = profile;
      }
    }
  }
  return plan;
}

/// Any camera and affine; an eye on the plan or past it, on a pixel's edge at times, between ground
/// and ceiling (or above all things where the top is open), but in no slab.
inline PanoramaRequest any_request(Rng& rng, const map::ColumnMap& plan) {
  const double pixel_m = plan.resolution_m;
  for (;;) {
    PanoramaRequest request;
    double u_m = rng.uniform(-8.0, plan.columns() + 8.0) * pixel_m;
    double v_m = rng.uniform(-8.0, plan.rows() + 8.0) * pixel_m;
    if (rng.below(4) == 0) u_m = std::round(u_m / pixel_m) * pixel_m;
    if (rng.below(4) == 0) v_m = std::round(v_m / pixel_m) * pixel_m;
    const Eigen::Vector2d eye = plan.map_from_plan(u_m, v_m);
    request.map_from_robot = {eye.x(), eye.y(), rng.below(4) == 0 ? 0.0 : rng.uniform(-3.1, 3.1)};
    request.eye_z_m = plan.ground_height_m + rng.uniform(0.05, plan.ceiling ? 2.55 : 4.0);
    bool in_slab = false;
    for (const auto& [du, dv] : {std::pair{-1, -1}, {-1, 1}, {1, -1}, {1, 1}, {0, 0}}) {
      const Eigen::Vector2d beside = plan.map_from_plan(u_m + 2e-3 * du, v_m + 2e-3 * dv);
      const ColumnProfile* profile = plan.at(beside.x(), beside.y());
      in_slab |= profile != nullptr &&
                 profile->reaches_into(request.eye_z_m - 2e-3, request.eye_z_m + 2e-3);
    }
    if (in_slab) continue;
    // Of eights: none looks along an edge or a diagonal, all of whose pixels would be ties.
    request.camera.columns = 40 + 8 * static_cast<int>(rng.below(26));
    request.camera.rows = 1 + static_cast<int>(rng.below(rng.below(8) == 0 ? 400 : 190));
    request.camera.elevation_min_rad = rng.uniform(-1.5, -0.1);
    request.camera.elevation_max_rad = rng.uniform(0.0, 1.5);
    if (rng.below(2) == 0) {
      request.affine = {rng.uniform(0.2, 5.0), rng.uniform(0.2, 5.0), rng.uniform(-2.0, 2.0)};
    }
    return request;
  }
}

/// Casts `views` views of `plans` plans each by both.
inline ColumnComparison compare_on_any_plans(std::uint64_t seed, int plans, int views) {
  ColumnComparison comparison;
  Rng rng(seed, "columns");
  for (int i = 0; i < plans; ++i) {
    const map::ColumnMap plan = any_plan(rng);
    const map::TriangleMesh mesh = map::extrude(plan);
    if (mesh.triangles.empty()) continue;
    const Scene scene = std::move(*Scene::build(mesh, {true}));
    const ColumnScene columns = ColumnScene::build(plan);
    for (int view = 0; view < views; ++view) {
      compare_casters(mesh, scene, columns, any_request(rng, plan), comparison);
    }
  }
  return comparison;
}

}  // namespace semview::raycast
