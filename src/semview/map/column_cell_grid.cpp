// SPDX-License-Identifier: Apache-2.0
/// The grid over a drawn map: `build_cell_grid`.
#include <algorithm>
#include <cmath>
#include <vector>

#include "semview/core/check.hpp"
#include "semview/map/cell_grid.hpp"

namespace semview::map {
namespace {

/// A robot drives over what is lower than this.
constexpr double kStepHeight_m = 0.05;
/// An eye this near to a face counts as touching it.
constexpr double kTouch_m = 1e-6;

/// What a column means for a cell whose centre lies in it.
struct ColumnUse {
  bool free = false;
  bool eye = false;
};

std::vector<ColumnUse> column_uses(const ColumnMap& map, double eye_height_m) {
  const double eye_z_m = map.ground_height_m + eye_height_m;
  const bool under_ceiling = !map.ceiling || eye_z_m < map.ceiling->height_m - kTouch_m;
  std::vector<ColumnUse> uses;
  for (const ColumnProfile& profile : map.profiles) {
    const bool blocked = profile.reaches_into(map.ground_height_m + kStepHeight_m, eye_z_m);
    const bool eye_hit = profile.reaches_into(eye_z_m - kTouch_m, eye_z_m + kTouch_m);
    uses.push_back({!profile.outside && (profile.passable || !blocked),
                    !profile.outside && !eye_hit && under_ceiling});
  }
  return uses;
}

class GridBuilder {
 public:
  GridBuilder(const ColumnMap& map, double eye_height_m)
      : map_(map), uses_(column_uses(map, eye_height_m)) {}

  std::uint8_t facts(const Pose2& center) const {
    std::uint8_t facts = 0;
    if (is_free(center.x_m, center.y_m)) facts |= CellGrid::kFree;
    if (has_eye(center)) facts |= CellGrid::kHasEye;
    if (facts & CellGrid::kFree) {
      if (is_open(center, PoseGrid::kCellSize_m, 0.0)) facts |= CellGrid::kEastOpen;
      if (is_open(center, 0.0, PoseGrid::kCellSize_m)) facts |= CellGrid::kNorthOpen;
    }
    return facts;
  }

 private:
  bool is_free(double x_m, double y_m) const {
    const std::optional<PixelIndex> pixel = map_.pixel_at(x_m, y_m);
    return pixel && uses_[map_.profile_of_pixel.at(pixel->row, pixel->column)].free;
  }

  /// True if no pixel that the eye's point touches (up to four) is in its way.
  bool has_eye(const Pose2& center) const {
    for (const double dx : {-kTouch_m, kTouch_m}) {
      for (const double dy : {-kTouch_m, kTouch_m}) {
        const std::optional<PixelIndex> pixel = map_.pixel_at(center.x_m + dx, center.y_m + dy);
        if (!pixel || !uses_[map_.profile_of_pixel.at(pixel->row, pixel->column)].eye) return false;
      }
    }
    return true;
  }

  /// Samples the way to a neighbour's centre four times a pixel.
  bool is_open(const Pose2& center, double dx_m, double dy_m) const {
    const double samples = std::ceil(4.0 * PoseGrid::kCellSize_m / map_.resolution_m) + 1.0;
    for (double i = 1.0; i <= samples; ++i) {
      const double part = i / samples;
      if (!is_free(center.x_m + part * dx_m, center.y_m + part * dy_m)) return false;
    }
    return true;
  }

  const ColumnMap& map_;
  std::vector<ColumnUse> uses_;
};

}  // namespace

CellGrid build_cell_grid(const ColumnMap& map, double eye_height_m) {
  const Bounds bounds = map.bounds();
  const std::optional<CellIndex> low = PoseGrid::cell(bounds.min_x_m, bounds.min_y_m);
  const std::optional<CellIndex> high = PoseGrid::cell(bounds.max_x_m, bounds.max_y_m);
  SEMVIEW_CHECK(low && high);
  const int columns = high->ix - low->ix + 1;
  const int rows = high->iy - low->iy + 1;
  const GridBuilder builder(map, eye_height_m);
  std::vector<std::uint8_t> facts;
  facts.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      facts.push_back(builder.facts(PoseGrid::center(CellIndex{low->ix + x, low->iy + y})));
    }
  }
  return {*low, columns, rows, std::move(facts)};
}

}  // namespace semview::map
