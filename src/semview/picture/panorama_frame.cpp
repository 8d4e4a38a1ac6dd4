// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/panorama_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "semview/geometry/angle.hpp"

namespace semview::picture {
namespace {

void draw_axes(cairo_t* cr, const Layout& layout, const PanoramaCamera& camera) {
  set_colour(cr, kInk);
  for (int azimuth_deg = 180; azimuth_deg >= -180; azimuth_deg -= 30) {
    const double x = layout.image_x + layout.image_width * (180.0 - azimuth_deg) / 360.0;
    const double y = layout.image_y + layout.image_height;
    fill_rectangle(cr, x - 0.5, y, 1.0, 5.0);
    draw_text(cr, x, y + 18.0, tick_text(azimuth_deg, 1.0) + "°", kSmallTextSize, Align::kCentre);
  }
  const double low_deg = deg_from_rad(camera.elevation_min_rad);
  const double high_deg = deg_from_rad(camera.elevation_max_rad);
  constexpr std::array<double, 7> kSteps{1.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0};
  const double rough = (high_deg - low_deg) * 34.0 / layout.image_height;
  const auto* const step = std::ranges::lower_bound(kSteps, rough);
  const double step_deg = step == kSteps.end() ? kSteps.back() : *step;
  for (double k = std::ceil(low_deg / step_deg - 1.0e-9); k * step_deg <= high_deg + 1.0e-9; ++k) {
    const double y =
        layout.image_y + layout.image_height * (high_deg - k * step_deg) / (high_deg - low_deg);
    fill_rectangle(cr, layout.image_x - 5.0, y - 0.5, 5.0, 1.0);
    draw_text(cr,
              layout.image_x - 8.0,
              y + 4.0,
              tick_text(k * step_deg, 1.0) + "°",
              kSmallTextSize,
              Align::kRight);
  }
}

std::string share_text(std::int64_t count, std::size_t total) {
  const double percent = 100.0 * static_cast<double>(count) / static_cast<double>(total);
  return percent < 0.1 ? "<0.1 %" : fmt::format("{:.{}f} %", percent, percent < 10.0 ? 1 : 0);
}

}  // namespace

Layout lay_out(int rows, int columns, const ViewPictureOptions& options) {
  Layout layout;
  if (options.axes) layout.image_x += 34.0;
  if (!options.title.empty()) layout.image_y += 30.0;
  layout.zoom = std::max(1.0, std::ceil(static_cast<double>(options.min_width_px) / columns));
  layout.image_width = columns * layout.zoom;
  layout.image_height = rows * layout.zoom;
  layout.below_y = layout.image_y + layout.image_height + (options.axes ? 24.0 : 0.0);
  return layout;
}

void draw_frame(cairo_t* cr,
                const Layout& layout,
                const RgbImage& image,
                const ViewPictureOptions& options) {
  if (!options.title.empty()) {
    set_colour(cr, kInk);
    draw_text(cr, layout.image_x, kMargin + 14.0, options.title, kTitleSize, Align::kLeft, true);
  }
  cairo_save(cr);
  cairo_translate(cr, layout.image_x, layout.image_y);
  cairo_scale(cr, layout.zoom, layout.zoom);
  paint_image(cr, image);
  cairo_restore(cr);
  set_colour(cr, kInk);
  outline_rectangle(cr, layout.image_x, layout.image_y, layout.image_width, layout.image_height);
  if (options.axes) draw_axes(cr, layout, *options.axes);
}

std::vector<LegendItem> legend_of(const LabelImage& labels,
                                  const ClassTable& classes,
                                  const ClassPalette& palette) {
  std::array<std::int64_t, 256> counts{};
  for (const ClassId label : labels.pixels()) ++counts[label];
  std::vector<int> ids;
  for (int id = 0; id < 256; ++id) {
    if (counts[static_cast<std::size_t>(id)] > 0) ids.push_back(id);
  }
  std::ranges::stable_sort(
      ids, std::greater<>(), [&counts](int id) { return counts[static_cast<std::size_t>(id)]; });
  std::vector<LegendItem> items;
  for (const int id : ids) {
    const auto label = static_cast<ClassId>(id);
    const std::string name = label == kNoHit ? "nothing" : std::string(classes.name(label));
    items.push_back({palette[label], name, share_text(counts[label], labels.pixels().size())});
  }
  return items;
}

RgbImage coloured(const LabelImage& labels, const ClassPalette& palette) {
  RgbImage image(labels.rows(), labels.columns());
  std::ranges::transform(labels.pixels(), image.pixels().begin(), [&palette](ClassId label) {
    return palette[label];
  });
  return image;
}

}  // namespace semview::picture
