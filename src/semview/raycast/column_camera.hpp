// SPDX-License-Identifier: Apache-2.0
/// The rays of a panorama's columns over a plan. Internal to this module.
#pragma once

#include <vector>

#include "semview/raycast/column_scene.hpp"
#include "semview/raycast/column_walk.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/raycast/row_finder.hpp"

namespace semview::raycast {

/// What of a camera is the same from every eye.
class ColumnCamera {
 public:
  explicit ColumnCamera(const PanoramaCamera& camera);

  const PanoramaCamera& camera() const { return camera_; }
  const RowFinder& rows() const { return rows_; }
  /// Range a metre of distance of an upright surface, row by row, and a metre of height of a level
  /// one.
  const std::vector<float>& secants() const { return secants_; }
  const std::vector<float>& cosecants() const { return cosecants_; }

  /// An eye nearer than 0.1 mm to a pixel's edge stands on the side that a ray looks to, as
  /// Embree's rays begin that much behind the eye.
  void aim(const ColumnScene& scene, const PanoramaRequest& request, ColumnRays& rays) const;

 private:
  PanoramaCamera camera_;
  RowFinder rows_;
  std::vector<double> cosines_;  // of each column's azimuth
  std::vector<double> sines_;
  std::vector<float> secants_;  // of each row's elevation
  std::vector<float> cosecants_;
};

}  // namespace semview::raycast
