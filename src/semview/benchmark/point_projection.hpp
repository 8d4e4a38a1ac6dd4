// SPDX-License-Identifier: Apache-2.0
/// Views as the 2017 paper makes them: a cloud of labelled points, the nearest a pixel. What the
/// ray casters are measured against.
#pragma once

#include <cstddef>
#include <vector>

#include "semview/geometry/panorama_camera.hpp"
#include "semview/map/column_map.hpp"
#include "semview/view/column_view.hpp"

namespace semview::benchmark {

/// Points in frame `map`, metres; the four have equal lengths.
struct PointCloud {
  std::vector<float> x_m;
  std::vector<float> y_m;
  std::vector<float> z_m;
  std::vector<ClassId> labels;

  std::size_t size() const { return labels.size(); }
};

/// One point for each voxel, as large as a pixel is wide, that a slab, the ground or the ceiling
/// lies in: the voxel's middle, and on ground and ceiling.
/// @source Neubert et al. 2017, section III-A. Differs: a pixel may hold several slabs.
PointCloud point_cloud(const map::ColumnMap& plan);

struct Eye {
  float x_m = 0.0F;
  float y_m = 0.0F;
  float z_m = 0.0F;
};

/// Keeps, for each pixel, the class of the nearest point whose direction falls into it, at yaw 0;
/// a pixel without points is `kNoHit`.
/// @source Neubert et al. 2017, section III-A; the literal form is
/// tests/reference/point_projection.hpp.
LabelImage project_points(const PointCloud& points, const Eye& eye, const PanoramaCamera& camera);

}  // namespace semview::benchmark
