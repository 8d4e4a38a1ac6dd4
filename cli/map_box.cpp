// SPDX-License-Identifier: Apache-2.0
#include "map_box.hpp"

#include <algorithm>

#include <Eigen/Geometry>

namespace semview::cli {

Box box_of(const map::SemanticMap& map) {
  if (const map::ColumnMap* columns = map.columns()) {
    const map::Bounds bounds = columns->bounds();
    double top_m = map.ground_height_m;
    for (const ColumnProfile& profile : columns->profiles) {
      if (!profile.slabs.empty()) top_m = std::max(top_m, profile.slabs.back().z_max_m);
    }
    if (map.ceiling) top_m = map.ceiling->height_m;
    return {{bounds.min_x_m, bounds.min_y_m, map.ground_height_m},
            {bounds.max_x_m, bounds.max_y_m, top_m}};
  }
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : map.mesh()->mesh.vertices) box.extend(vertex);
  return {box.min().cast<double>(), box.max().cast<double>()};
}

}  // namespace semview::cli
