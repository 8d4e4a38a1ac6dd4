// SPDX-License-Identifier: Apache-2.0
#include "semview/map/distortion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/io/png.hpp"
#include "semview/map/fingerprint.hpp"

namespace semview::map {
namespace {

Status check(const MapAffine& affine) {
  if (affine.in_range()) return {};
  return fail(
      ErrorCode::kInvalidArgument,
      fmt::format("scale {}, {} and shear {}: expected scales of 0.2 to 5 and a shear of -2 to 2",
                  affine.a,
                  affine.b,
                  affine.k));
}

/// The rectangle that holds the distorted image.
Bounds distorted_bounds(const ColumnMap& drawn, const MapAffine& affine) {
  const double width_m = drawn.columns() * drawn.resolution_m;
  const double height_m = drawn.rows() * drawn.resolution_m;
  Bounds bounds{INFINITY, INFINITY, -INFINITY, -INFINITY};
  for (const double u_m : {0.0, width_m}) {
    for (const double v_m : {0.0, height_m}) {
      const Eigen::Vector2d corner = drawn.map_from_plan(u_m, v_m);
      const Pose2 moved = distort(Pose2{corner.x(), corner.y(), 0.0}, affine);
      bounds.min_x_m = std::min(bounds.min_x_m, moved.x_m);
      bounds.min_y_m = std::min(bounds.min_y_m, moved.y_m);
      bounds.max_x_m = std::max(bounds.max_x_m, moved.x_m);
      bounds.max_y_m = std::max(bounds.max_y_m, moved.y_m);
    }
  }
  return bounds;
}

/// Leaves out the profiles of objects that no pixel has any more, and puts the others in the order
/// of their first pixels: as they are when the map is read from files.
void order_objects(ColumnMap& columns, PlanObjects& objects) {
  const std::size_t classes = columns.profiles.size() - objects.profiles.size();
  std::vector<int> place_of(columns.profiles.size(), -1);
  for (std::size_t i = 0; i < classes; ++i) place_of[i] = static_cast<int>(i);
  std::vector<ColumnProfile> profiles(columns.profiles.begin(),
                                      columns.profiles.begin() + static_cast<long>(classes));
  std::vector<MapClass> own;
  for (std::uint8_t& pixel : columns.profile_of_pixel.pixels()) {
    int& place = place_of[pixel];
    if (place < 0) {
      place = static_cast<int>(profiles.size());
      profiles.push_back(columns.profiles[pixel]);
      own.push_back(objects.profiles[pixel - classes]);
    }
    pixel = static_cast<std::uint8_t>(place);
  }
  columns.profiles = std::move(profiles);
  objects.profiles = std::move(own);
}

}  // namespace

Result<SemanticMap> distort(const SemanticMap& drawn, const MapAffine& affine) {
  SEMVIEW_TRY_STATUS(check(affine));
  const ColumnMap* before = drawn.columns();
  if (before == nullptr) {
    return fail(ErrorCode::kUnimplemented,
                fmt::format("map {} is a mesh: only drawn plans can be distorted", drawn.id));
  }
  const Bounds bounds = distorted_bounds(*before, affine);
  const double columns = std::ceil((bounds.max_x_m - bounds.min_x_m) / before->resolution_m - 1e-6);
  const double rows = std::ceil((bounds.max_y_m - bounds.min_y_m) / before->resolution_m - 1e-6);
  if (std::max(rows, columns) > io::kMaxPngSide_px ||
      rows * columns > static_cast<double>(io::kMaxPngPixels)) {
    return fail(
        ErrorCode::kResourceExhausted,
        fmt::format("map {} would have {:.0f} x {:.0f} pixels: expected at most {} a side and {}",
                    drawn.id,
                    columns,
                    rows,
                    io::kMaxPngSide_px,
                    io::kMaxPngPixels));
  }
  ColumnMap after = *before;
  after.origin = {bounds.min_x_m, bounds.min_y_m, 0.0};
  after.profile_of_pixel =
      Image<std::uint8_t>(static_cast<int>(rows), static_cast<int>(columns), std::uint8_t{0});
  for (int row = 0; row < after.rows(); ++row) {
    for (int column = 0; column < after.columns(); ++column) {
      const Eigen::Vector2d center = after.pixel_center({row, column});
      const double x_m = center.x() / affine.a;
      const auto pixel = before->pixel_at(x_m, (center.y() - affine.k * x_m) / affine.b);
      if (!pixel) continue;
      after.profile_of_pixel.at(row, column) =
          before->profile_of_pixel.at(pixel->row, pixel->column);
    }
  }
  SemanticMap distorted = drawn;
  order_objects(after, distorted.objects);
  distorted.geometry = std::move(after);
  distorted.fingerprint = fingerprint_of(distorted);
  return distorted;
}

}  // namespace semview::map
