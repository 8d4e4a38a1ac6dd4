// SPDX-License-Identifier: Apache-2.0
/// Rectangles between the corners of a plan's pixels as triangles that share their vertices.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>

#include <Eigen/Core>

#include "semview/map/column_map.hpp"
#include "semview/map/triangle_mesh.hpp"

namespace semview::map {

/// A corner of pixels: column edge `i` (0 = left edge), row edge `j` (0 = top edge).
struct Corner {
  int i = 0;
  int j = 0;
  float z_m = 0.0F;
};

class MeshBuilder {
 public:
  /// `map` must outlive it.
  explicit MeshBuilder(const ColumnMap& map) : map_(map) {}

  /// Corners counter-clockwise as seen from free space, the other way round if `turned`.
  void add_quad(const std::array<Corner, 4>& corners, bool turned, ClassId label) {
    std::array<std::uint32_t, 4> v{};
    for (std::size_t k = 0; k < 4; ++k) v[k] = vertex(corners[turned ? 3 - k : k]);
    mesh_.triangles.push_back({v[0], v[1], v[2]});
    mesh_.triangles.push_back({v[0], v[2], v[3]});
    mesh_.labels.insert(mesh_.labels.end(), 2, label);
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t vertex(const Corner& corner) {
    const auto level = static_cast<std::uint64_t>(
        level_of_.try_emplace(corner.z_m, level_of_.size()).first->second);
    const std::uint64_t key = (level << 48U) | (static_cast<std::uint64_t>(corner.j) << 24U) |
                              static_cast<std::uint64_t>(corner.i);
    const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
    const auto [place, is_new] = vertex_of_.try_emplace(key, next);
    if (is_new) {
      const Eigen::Vector2d point = map_.map_from_plan(
          corner.i * map_.resolution_m, (map_.rows() - corner.j) * map_.resolution_m);
      mesh_.vertices.emplace_back(
          static_cast<float>(point.x()), static_cast<float>(point.y()), corner.z_m);
    }
    return place->second;
  }

  const ColumnMap& map_;
  std::map<float, std::size_t> level_of_;
  std::unordered_map<std::uint64_t, std::uint32_t> vertex_of_;
  TriangleMesh mesh_;
};

}  // namespace semview::map
