// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "semview/benchmark/office_plan.hpp"
#include "semview/io/png.hpp"
#include "semview/io/text_file.hpp"
#include "semview/map/occupancy.hpp"

namespace semview::benchmark {

Status write_office(const OfficePlan& plan, const std::filesystem::path& directory) {
  SEMVIEW_TRY(const map::SemanticMap map, draw_office(plan));
  const map::ColumnMap& columns = *map.columns();
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  std::string yaml = fmt::format(
      "image: occupancy.png\nresolution: {:g}\norigin: [0, 0, 0]\nnegate: 0\n"
      "occupied_thresh: 0.65\nfree_thresh: 0.196\nsemview:\n  format: 1\n  name: {}\n"
      "  labels: labels.png\n  ceiling: {{class: ceiling, height: {:g}}}\n"
      "  ground: {{class: floor, height: 0}}\n  outside: [0, 0, 0]\n  classes:\n",
      plan.resolution_m,
      map.name,
      columns.ceiling->height_m);
  for (const map::MapClass& own : map.class_details) {
    yaml += fmt::format("    - {{name: {}", own.name);
    if (own.color) {
      yaml += fmt::format(", color: [{}, {}, {}], min_height: {:g}, max_height: {:g}",
                          own.color->r,
                          own.color->g,
                          own.color->b,
                          own.min_height_m,
                          own.max_height_m);
    }
    if (!own.below.empty()) yaml += ", below: " + own.below;
    if (!own.above.empty()) yaml += ", above: " + own.above;
    yaml += "}\n";
  }
  std::vector<const map::MapClass*> drawn;
  for (const map::MapClass& own : map.class_details) {
    if (own.color) drawn.push_back(&own);
  }
  RgbImage labels(columns.rows(), columns.columns());
  for (std::size_t i = 0; i < labels.pixels().size(); ++i) {
    const std::uint8_t profile = columns.profile_of_pixel.pixels()[i];
    if (profile != 0) labels.pixels()[i] = *drawn[profile - 1U]->color;
  }
  SEMVIEW_TRY_STATUS(io::write_png(directory / "labels.png", labels));
  SEMVIEW_TRY_STATUS(io::write_png(directory / "occupancy.png", map::occupancy_image(columns)));
  return io::write_text_file(directory / "map.yaml", yaml);
}

}  // namespace semview::benchmark
