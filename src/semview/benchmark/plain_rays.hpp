// SPDX-License-Identifier: Apache-2.0
/// The loop over rtcIntersect1 that a reader of Embree's manual writes.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "semview/map/triangle_mesh.hpp"
#include "semview/raycast/panorama_renderer.hpp"

namespace semview::benchmark {

/// Where a view's rays go, row by row; unit vectors.
std::vector<std::array<float, 3>> directions_of(const raycast::PanoramaRequest& request);

/// A scene of the best build quality, not robust, and one rtcIntersect1 a ray.
class PlainRays {
 public:
  explicit PlainRays(const map::TriangleMesh& mesh);
  ~PlainRays();

  /// `directions` are those of the request, made beforehand: only casting is measured.
  raycast::Panorama cast(const raycast::PanoramaRequest& request,
                         const std::vector<std::array<float, 3>>& directions) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
  std::vector<ClassId> labels_;
};

}  // namespace semview::benchmark
