// SPDX-License-Identifier: Apache-2.0
/// A labelled triangle mesh, ready to be looked at.
#pragma once

#include <cstddef>
#include <memory>

#include <Eigen/Core>

#include "semview/core/result.hpp"
#include "semview/map/triangle_mesh.hpp"

namespace semview::map {
struct SemanticMap;
}

namespace semview::raycast {

/// More than any building needs; Embree takes about 100 bytes a triangle.
inline constexpr std::size_t kMaxTriangles = 50'000'000;

struct SceneConfig {
  /// Watertight edges: no ray slips between two triangles that share one. Without it casting is
  /// about 1.3 times as fast (bench/raycast_bench.cpp).
  bool robust = true;
};

/// An axis-aligned box in frame `map`, metres.
struct SceneBounds {
  Eigen::Vector3f min = Eigen::Vector3f::Zero();
  Eigen::Vector3f max = Eigen::Vector3f::Zero();
};

/// An immutable ray-casting scene over a triangle mesh; the mesh is not needed any more once it is
/// built. Embree stays behind this type.
///
/// @threads All const use is safe from several threads at once.
class Scene {
 public:
  /// @errors kInvalidArgument: no triangles, more than `kMaxTriangles`, not one label a triangle,
  /// an index past the vertices, a coordinate that is not finite; kInternal: Embree gave up.
  static Result<Scene> build(const map::TriangleMesh& mesh, const SceneConfig& config = {});

  /// Of a map's mesh, or of its extruded plan.
  static Result<Scene> build(const map::SemanticMap& map);

  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene();

  const SceneBounds& bounds() const;
  std::size_t triangles() const;

  struct Impl;
  /// For the renderers of this module.
  const Impl& impl() const { return *impl_; }

 private:
  explicit Scene(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace semview::raycast
