// SPDX-License-Identifier: Apache-2.0
/// Meshes and plans made in code for the ray-casting tests.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>

#include <Eigen/Core>

#include "semview/core/random.hpp"
#include "semview/map/column_map.hpp"
#include "semview/map/triangle_mesh.hpp"

namespace semview::raycast {

// Classes of `box_room`: one a face.
inline constexpr ClassId kFloor = 1, kCeiling = 2, kWest = 3, kEast = 4, kSouth = 5, kNorth = 6;

inline void add_quad(map::TriangleMesh& mesh,
                     std::initializer_list<Eigen::Vector3f> corners,
                     ClassId label) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
  mesh.labels.insert(mesh.labels.end(), 2, label);
}

/// The inside of an axis-aligned box, its faces looking inwards.
inline map::TriangleMesh box_room(const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  const float x0 = low.x(), y0 = low.y(), z0 = low.z();
  const float x1 = high.x(), y1 = high.y(), z1 = high.z();
  map::TriangleMesh mesh;
  add_quad(mesh, {{x0, y0, z0}, {x1, y0, z0}, {x1, y1, z0}, {x0, y1, z0}}, kFloor);
  add_quad(mesh, {{x0, y0, z1}, {x0, y1, z1}, {x1, y1, z1}, {x1, y0, z1}}, kCeiling);
  add_quad(mesh, {{x0, y0, z0}, {x0, y1, z0}, {x0, y1, z1}, {x0, y0, z1}}, kWest);
  add_quad(mesh, {{x1, y0, z0}, {x1, y0, z1}, {x1, y1, z1}, {x1, y1, z0}}, kEast);
  add_quad(mesh, {{x0, y0, z0}, {x0, y0, z1}, {x1, y0, z1}, {x1, y0, z0}}, kSouth);
  add_quad(mesh, {{x0, y1, z0}, {x1, y1, z0}, {x1, y1, z1}, {x0, y1, z1}}, kNorth);
  return mesh;
}

/// Random triangles within ±5 m.
inline map::TriangleMesh random_mesh(Rng& rng, int triangles) {
  map::TriangleMesh mesh;
  const auto coordinate = [&](double middle, double spread) {
    return static_cast<float>(middle + rng.uniform(-spread, spread));
  };
  for (int i = 0; i < triangles; ++i) {
    const double x = rng.uniform(-4.0, 4.0), y = rng.uniform(-4.0, 4.0), z = rng.uniform(-2.0, 2.0);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int k = 0; k < 3; ++k) {
      mesh.vertices.emplace_back(coordinate(x, 1.0), coordinate(y, 1.0), coordinate(z, 1.0));
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.labels.push_back(static_cast<ClassId>(1 + rng.below(20)));
  }
  return mesh;
}

// Classes of `random_plan`.
inline constexpr ClassId kPlanFloor = 1, kPlanCeiling = 2, kPlanWall = 3, kPlanTable = 4,
                         kPlanDoor = 5, kPlanWindow = 6, kPlanRug = 7;

/// A closed plan: walls all around, and inside them free floor, rugs, tables, doors with lintels,
/// windows with sills and more wall, pixel by pixel at random. The middle pixel is free.
inline map::ColumnMap random_plan(Rng& rng, int rows, int columns) {
  map::ColumnMap plan;
  plan.resolution_m = 0.5;
  plan.origin = {rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0), rng.uniform(-3.1, 3.1)};
  plan.ground_height_m = 0.0;
  plan.ceiling = map::Ceiling{kPlanCeiling, 2.6};
  const ColumnProfile free{false, false, kPlanFloor, {}};
  plan.profiles = {
      ColumnProfile{true, false, kNoHit, {}},
      free,
      {false, false, kPlanFloor, {{0.0, 2.6, kPlanWall}}},
      {false, false, kPlanFloor, {{0.7, 0.75, kPlanTable}}},
      {false, true, kPlanFloor, {{0.0, 2.1, kPlanDoor}, {2.1, 2.6, kPlanWall}}},
      {false,
       false,
       kPlanFloor,
       {{0.0, 0.9, kPlanWall}, {0.9, 2.1, kPlanWindow}, {2.1, 2.6, kPlanWall}}},
      {false, false, kPlanRug, {}},
  };
  plan.profile_of_pixel = Image<std::uint8_t>(rows, columns, 2);
  for (int r = 1; r + 1 < rows; ++r) {
    for (int c = 1; c + 1 < columns; ++c) {
      const bool empty = rng.uniform() < 0.6;
      plan.profile_of_pixel.at(r, c) =
          empty ? std::uint8_t{1} : static_cast<std::uint8_t>(1 + rng.below(6));
    }
  }
  plan.profile_of_pixel.at(rows / 2, columns / 2) = 1;
  return plan;
}

}  // namespace semview::raycast
