// SPDX-License-Identifier: Apache-2.0
#include "plan_backdrop.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "semview/map/occupancy.hpp"
#include "semview/picture/class_palette.hpp"

namespace semview::cli {

Result<picture::Plan> plan_backdrop(const map::SemanticMap& map) {
  const map::ColumnMap* columns = map.columns();
  if (columns == nullptr) {
    return fail(ErrorCode::kFailedPrecondition,
                fmt::format("{}: a mesh map has no plan to draw on", map.id));
  }
  picture::ClassPalette palette = picture::ClassPalette::for_classes(map.classes);
  palette.set(map.ground_label, {250, 247, 240});
  if (const auto wall = map.classes.id("wall")) palette.set(*wall, {104, 108, 116});
  std::map<Rgb, Rgb> quiet;
  for (std::size_t i = 0; i < map.class_details.size(); ++i) {
    const std::optional<Rgb>& drawn = map.class_details[i].color;
    if (drawn) quiet.emplace(*drawn, palette[static_cast<ClassId>(i + 1)]);
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
