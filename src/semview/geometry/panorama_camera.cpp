// SPDX-License-Identifier: Apache-2.0
#include "semview/geometry/panorama_camera.hpp"

#include <algorithm>
#include <cmath>

namespace semview {

int PanoramaCamera::column_of(double azimuth_rad) const {
  const double turns_from_left_edge = (kPi - wrap_angle(azimuth_rad)) / kTwoPi;
  return std::clamp(static_cast<int>(std::floor(turns_from_left_edge * columns)), 0, columns - 1);
}

int PanoramaCamera::row_of(double elevation_rad) const {
  const double from_top =
      (elevation_max_rad - elevation_rad) / (elevation_max_rad - elevation_min_rad) * rows;
  if (!(from_top >= 0.0 && from_top < rows)) return -1;
  return static_cast<int>(from_top);
}

Eigen::Vector3d PanoramaCamera::direction(int row, int column) const {
  const double azimuth = azimuth_rad(column);
  const double elevation = elevation_rad(row);
  return {std::cos(elevation) * std::cos(azimuth),
          std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

}  // namespace semview
