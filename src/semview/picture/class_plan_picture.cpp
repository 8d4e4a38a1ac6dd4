// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/class_plan_picture.hpp"

#include <algorithm>
#include <cstddef>
#include <map>

#include <fmt/format.h>

#include "semview/picture/legend.hpp"
#include "semview/picture/plan_frame.hpp"

namespace semview::picture {
namespace {

std::string area_text(double area_m2) {
  return area_m2 < 0.1 ? "<0.1 m²" : fmt::format("{:.{}f} m²", area_m2, area_m2 < 10.0 ? 1 : 0);
}

std::vector<LegendItem> legend_of(const ClassPlanPicture& picture) {
  std::map<Rgb, std::size_t> pixels;
  for (const Rgb& colour : picture.plan.image.pixels()) ++pixels[colour];
  const double pixel_m2 = picture.plan.resolution_m * picture.plan.resolution_m;
  std::vector<LegendItem> items;
  for (const PlanClass& entry : picture.classes) {
    const auto found = pixels.find(entry.colour);
    if (found == pixels.end()) continue;
    const double area_m2 = static_cast<double>(found->second) * pixel_m2;
    items.push_back({entry.colour, entry.name, area_text(area_m2)});
  }
  return items;
}

}  // namespace

RgbImage draw_class_plan(const ClassPlanPicture& picture) {
  const Extent extent = extent_of(picture.plan);
  if (extent.empty()) return {};
  const PlanFrame frame(extent, picture.width_px, 0.0, !picture.title.empty());
  std::vector<LegendItem> legend = legend_of(picture);
  // Under a narrow plan the legend still gets lines of a few entries.
  const double legend_width = std::max(frame.width(), picture.width_px / 2.0);
  const double legend_y = frame.below() + 44.0;
  const double legend_height = arrange(legend, legend_width);
  const Size size{frame.left() + legend_width + kMargin, legend_y + legend_height + kMargin};
  return draw_pixels(size, [&](cairo_t* cr) {
    frame.draw_plan(cr, picture.plan, 0.0);
    frame.draw_edges(cr, picture.title);
    frame.draw_scale_bar(cr, frame.left(), frame.below() + 18.0);
    draw_legend(cr, legend, frame.left(), legend_y);
  });
}

}  // namespace semview::picture
