// SPDX-License-Identifier: Apache-2.0
/// Labelled triangles: the geometry that rays are cast at.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "semview/semantics/class_table.hpp"

namespace semview::map {

/// Triangles in frame `map`, metres, each with one class.
///
/// Front faces are counter-clockwise seen from free space; ray casting ignores the side, pictures
/// and exported files use it. `labels` has one entry a triangle; every index is a vertex's.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<ClassId> labels;
};

/// Above these a mesh from a file is refused: far past any building, well within 32-bit indices.
inline constexpr std::size_t kMaxMeshVertices = 50'000'000;
inline constexpr std::size_t kMaxMeshTriangles = 50'000'000;

}  // namespace semview::map
