// SPDX-License-Identifier: Apache-2.0
/// A plan as columns: what stands over each pixel. All that is downstream of a drawing knows only
/// this.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "semview/geometry/image.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/semantics/column_profile.hpp"

namespace semview::map {

/// The ceiling's lower face, over everything that is not outside.
struct Ceiling {
  ClassId label = kNoHit;
  double height_m = 0.0;  ///< in frame `map`

  bool operator==(const Ceiling&) const = default;
};

struct PixelIndex {
  int row = 0;
  int column = 0;

  bool operator==(const PixelIndex&) const = default;
};

/// Smallest axis-parallel rectangle, metres in frame `map`.
struct Bounds {
  double min_x_m = 0.0;
  double min_y_m = 0.0;
  double max_x_m = 0.0;
  double max_y_m = 0.0;
};

/// One column profile a pixel. Profile 0 is `outside`.
///
/// `origin` is the pose of the lower-left corner of the lower-left pixel (ROS map_server); image
/// row 0 is the uppermost. Plan coordinates are metres from that corner along the image's own axes:
/// u to the right, v up; with origin yaw 0 they differ from frame `map` by a shift only.
struct ColumnMap {
  Image<std::uint8_t> profile_of_pixel;
  std::vector<ColumnProfile> profiles;  ///< profiles[0].outside; slabs cut at ground and ceiling
  double resolution_m = 0.0;            ///< edge of a pixel
  Pose2 origin;                         ///< map_from_plan
  double ground_height_m = 0.0;
  std::optional<Ceiling> ceiling;  ///< none: open top

  int rows() const { return profile_of_pixel.rows(); }
  int columns() const { return profile_of_pixel.columns(); }

  const ColumnProfile& profile(int row, int column) const {
    return profiles[profile_of_pixel.at(row, column)];
  }

  /// Plan coordinates (u, v) of a point of frame `map`, and back.
  Eigen::Vector2d plan_from_map(double x_m, double y_m) const;
  Eigen::Vector2d map_from_plan(double u_m, double v_m) const;

  /// The pixel that holds a point (left and lower edges belong to it); none past the image.
  std::optional<PixelIndex> pixel_at(double x_m, double y_m) const;
  /// The column over a point; null past the image, which is as good as outside.
  const ColumnProfile* at(double x_m, double y_m) const;
  /// Frame `map`'s coordinates of a pixel's centre.
  Eigen::Vector2d pixel_center(const PixelIndex& pixel) const;

  /// Of the whole image, turned by the origin's yaw.
  Bounds bounds() const;
};

}  // namespace semview::map
