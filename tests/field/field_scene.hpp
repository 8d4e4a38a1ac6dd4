// SPDX-License-Identifier: Apache-2.0
/// A small furnished room, what a camera sees of it, and what a mapping run would have made of it.
#pragma once

#include <cmath>

#include "semview/core/random.hpp"
#include "semview/field/semantic_volume.hpp"
#include "semview/map/column_map.hpp"
#include "semview/view/depth_observation.hpp"

namespace semview::field {

inline ClassTable room_classes() {
  return ClassTable({"floor", "ceiling", "wall", "table", "shelf", "lamp"});  // no lamp is there
}

/// 3 × 2.4 m with a table and a shelf, turned a little.
inline map::ColumnMap room() {
  map::ColumnMap plan;
  plan.resolution_m = 0.05;
  plan.origin = {-1.3, 0.7, 0.4};
  plan.ground_height_m = 0.2;
  plan.ceiling = map::Ceiling{2, 2.2};
  const auto column = [](std::vector<Slab> slabs) {
    return ColumnProfile{false, false, 1, std::move(slabs)};
  };
  plan.profiles = {ColumnProfile{true, false, kNoHit, {}},
                   column({}),
                   column({{0.2, 2.2, 3}}),
                   column({{0.85, 0.95, 4}}),
                   column({{0.2, 1.6, 5}})};
  plan.profile_of_pixel = Image<std::uint8_t>(48, 60, 1);
  for (int row = 0; row < 48; ++row) {
    for (int c = 0; c < 60; ++c) {
      std::uint8_t& pixel = plan.profile_of_pixel.at(row, c);
      if (row < 3 || row > 44 || c < 3 || c > 56) pixel = 2;
      if (row == 0 || c == 0) pixel = 0;
      if (row > 12 && row < 26 && c > 34 && c < 50) pixel = 3;
      if (row > 36 && row < 45 && c > 10 && c < 34) pixel = 4;
    }
  }
  return plan;
}

/// The class that fills a place; `kNoHit` for air, `kUnknown` outside.
inline ClassId label_at(const map::ColumnMap& plan, const Eigen::Vector3d& point_map) {
  const ColumnProfile* column = plan.at(point_map.x(), point_map.y());
  if (column == nullptr || column->outside) return kUnknown;
  for (const Slab& slab : column->slabs) {
    if (point_map.z() >= slab.z_min_m && point_map.z() <= slab.z_max_m) return slab.label;
  }
  if (point_map.z() <= plan.ground_height_m) return column->ground;
  return plan.ceiling && point_map.z() >= plan.ceiling->height_m ? plan.ceiling->label : kNoHit;
}

/// Depth and labels at a pose in the room, in steps of 1 cm, some pixels without depth or class.
inline DepthObservation photograph(const map::ColumnMap& plan, const Pose2& map_from_base) {
  DepthObservation seen;
  seen.classes = room_classes();
  seen.camera = {40, 30, 33.0, 33.0, 20.0, 15.0};
  seen.depth_m = Image<float>(30, 40, 0.0F);
  seen.labels = LabelImage(30, 40, kUnknown);
  Eigen::Matrix3d level;  // x right, y down, z forward
  level << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  seen.base_from_camera.translate(Eigen::Vector3d(0.1, 0.02, 0.9));
  seen.base_from_camera.rotate(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()));
  seen.base_from_camera.rotate(level);
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
  map_from_camera.translate(
      Eigen::Vector3d(map_from_base.x_m, map_from_base.y_m, plan.ground_height_m));
  map_from_camera.rotate(Eigen::AngleAxisd(map_from_base.yaw_rad, Eigen::Vector3d::UnitZ()));
  map_from_camera = map_from_camera * seen.base_from_camera;
  for (int row = 0; row < 30; ++row) {
    for (int column = 0; column < 40; ++column) {
      if ((row * 40 + column) % 29 == 0) continue;
      for (double depth = 0.1; depth < 5.0; depth += 0.01) {
        const ClassId label =
            label_at(plan, map_from_camera * (depth * seen.camera.direction(row, column)));
        if (label == kNoHit) continue;
        seen.depth_m.at(row, column) = static_cast<float>(depth);
        if ((row + column) % 11 != 0) seen.labels.at(row, column) = label;
        break;
      }
    }
  }
  return seen;
}

/// The room as voxels: sdf within the truncation distance, classes at surfaces, some never seen.
inline SemanticVolume volume_of_room(const map::ColumnMap& plan, Rng& rng) {
  SemanticVolume volume({0.05, 0.15}, room_classes());
  const map::Bounds bounds = plan.bounds();
  const VoxelIndex low = volume.voxel_at({bounds.min_x_m, bounds.min_y_m, 0.0});
  const VoxelIndex high = volume.voxel_at({bounds.max_x_m, bounds.max_y_m, 2.4});
  for (int z = low.z; z <= high.z; ++z) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        const VoxelIndex at{x, y, z};
        const ClassId label = label_at(plan, volume.centre(at));
        if (label == kUnknown || rng.uniform(0.0, 1.0) < 0.1) continue;
        VoxelBlock& block = volume.add_block(SemanticVolume::block_of(at));
        const std::size_t place = SemanticVolume::place_in_block(at);
        block.weight[place] = 1.0F;
        block.sdf_m[place] = static_cast<float>(rng.uniform(-0.15, 0.15));
        if (label != kNoHit) block.count(place, label, 2);
      }
    }
  }
  return volume;
}

}  // namespace semview::field
