// SPDX-License-Identifier: Apache-2.0
/// The spherical camera of all views: pixel ↔ direction. See docs/conventions.md#panorama.
#pragma once

#include <Eigen/Core>

#include "semview/geometry/angle.hpp"

namespace semview {

/// An equirectangular panorama over 360°, stored as a photograph: the heading is in the middle,
/// what is left of it (counter-clockwise) on the left; row 0 looks highest.
struct PanoramaCamera {
  int columns = 360;
  int rows = 90;
  double elevation_min_rad = -kPi / 4.0;  ///< lower edge of the last row
  double elevation_max_rad = kPi / 4.0;   ///< upper edge of row 0

  bool operator==(const PanoramaCamera&) const = default;

  /// Azimuth of the centre of a column, counter-clockwise from the heading, in (-π, π).
  double azimuth_rad(int column) const { return kPi - (column + 0.5) * kTwoPi / columns; }

  /// Elevation of the centre of a row above the horizon.
  double elevation_rad(int row) const {
    return elevation_max_rad - (row + 0.5) * (elevation_max_rad - elevation_min_rad) / rows;
  }

  /// The column whose interval of azimuth holds `azimuth_rad` (any finite angle, wrapped).
  int column_of(double azimuth_rad) const;

  /// The row whose interval of elevation holds `elevation_rad`, or -1 above or below the image.
  int row_of(double elevation_rad) const;

  /// Unit direction of a pixel centre in the frame of the robot (x along the heading, z up).
  Eigen::Vector3d direction(int row, int column) const;
};

}  // namespace semview
