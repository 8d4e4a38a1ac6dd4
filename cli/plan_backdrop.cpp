// SPDX-License-Identifier: Apache-2.0
#include "plan_backdrop.hpp"

#include <map>

#include "map_verbs.hpp"
#include "semview/map/occupancy.hpp"
#include "semview/picture/class_palette.hpp"

namespace semview::cli {
namespace {

constexpr double kDefaultEyeHeight_m = 1.2;  // as of every verb that casts views

}  // namespace

Result<picture::Plan> free_cells_plan(const map::SemanticMap& map) {
  SEMVIEW_TRY(const map::CellGrid grid, cell_grid_of(map, kDefaultEyeHeight_m));
  picture::Plan plan;
  plan.image = RgbImage(grid.rows(), grid.columns());
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const CellIndex cell{grid.minimum().ix + column, grid.minimum().iy + grid.rows() - 1 - row};
      plan.image.at(row, column) = grid.is_free(cell) ? kFreeColour : Rgb{255, 255, 255};
    }
  }
  plan.resolution_m = PoseGrid::kCellSize_m;
  const Pose2 lowest = PoseGrid::center(grid.minimum());
  plan.origin = {
      lowest.x_m - PoseGrid::kCellSize_m / 2.0, lowest.y_m - PoseGrid::kCellSize_m / 2.0, 0.0};
  return plan;
}

Result<picture::Plan> plan_backdrop(const map::SemanticMap& map) {
  const map::ColumnMap* columns = map.columns();
  if (columns == nullptr) return free_cells_plan(map);
  picture::ClassPalette palette = picture::ClassPalette::for_classes(map.classes);
  palette.set(map.ground_label, {250, 247, 240});
  if (const auto wall = map.classes.id("wall")) palette.set(*wall, {104, 108, 116});
  std::map<Rgb, Rgb> quiet;
  for (std::size_t i = 0; i < map.class_details.size(); ++i) {
    const std::optional<Rgb>& drawn = map.class_details[i].color;
    if (!drawn) continue;
    const Rgb shown = palette[static_cast<ClassId>(i + 1)];
    quiet.emplace(*drawn, shown);
    quiet.emplace(map::object_color(*drawn), map::object_color(shown));
  }
  RgbImage image = map::plan_image(map, *columns);
  for (Rgb& pixel : image.pixels()) {
    // The outside's white is no class's colour.
    const auto found = quiet.find(pixel);
    if (found != quiet.end()) pixel = found->second;
  }
  return picture::Plan{std::move(image), columns->resolution_m, columns->origin};
}

}  // namespace semview::cli
