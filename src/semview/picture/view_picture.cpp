// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/view_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/picture/canvas.hpp"
#include "semview/picture/colour_map.hpp"
#include "semview/picture/legend.hpp"

namespace semview::picture {
namespace {

/// Where the parts of a picture stand.
struct Layout {
  double image_x = kMargin;
  double image_y = kMargin;
  double zoom = 1.0;
  double image_width = 0.0;
  double image_height = 0.0;
  double below_y = 0.0;  ///< under the image and its axis
};

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

/// Half of either colour.
Rgb mixed(const Rgb& a, const Rgb& b) {
  const auto half = [](int x, int y) { return static_cast<unsigned char>((x + y) / 2); };
  return {half(a.r, b.r), half(a.g, b.g), half(a.b, b.b)};
}

std::string share_text(std::int64_t count, std::size_t total) {
  const double percent = 100.0 * static_cast<double>(count) / static_cast<double>(total);
  return percent < 0.1 ? "<0.1 %" : fmt::format("{:.{}f} %", percent, percent < 10.0 ? 1 : 0);
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

}  // namespace

RgbImage draw_labels(const LabelImage& labels,
                     const ClassTable& classes,
                     const ClassPalette& palette,
                     const ViewPictureOptions& options) {
  if (labels.empty()) return {};
  RgbImage image(labels.rows(), labels.columns());
  std::ranges::transform(labels.pixels(), image.pixels().begin(), [&palette](ClassId label) {
    return palette[label];
  });
  const Layout layout = lay_out(labels.rows(), labels.columns(), options);
  std::vector<LegendItem> legend = legend_of(labels, classes, palette);
  const double legend_height = arrange(legend, layout.image_width);
  const Size size{layout.image_x + layout.image_width + kMargin,
                  layout.below_y + 16.0 + legend_height + kMargin - 4.0};
  return draw_pixels(size, [&](cairo_t* cr) {
    draw_frame(cr, layout, image, options);
    draw_legend(cr, legend, layout.image_x, layout.below_y + 16.0);
  });
}

RgbImage draw_overlay(const RgbImage& photo,
                      const LabelImage& labels,
                      const ClassTable& classes,
                      const ClassPalette& palette,
                      const ViewPictureOptions& options) {
  SEMVIEW_CHECK(photo.rows() == labels.rows() && photo.columns() == labels.columns());
  if (labels.empty()) return {};
  RgbImage coloured(photo.rows(), photo.columns());
  for (std::size_t i = 0; i < coloured.pixels().size(); ++i) {
    coloured.pixels()[i] = mixed(photo.pixels()[i], palette[labels.pixels()[i]]);
  }
  const Layout above = lay_out(labels.rows(), labels.columns(), options);
  Layout below = above;
  below.image_y = above.below_y + 12.0;
  below.below_y = below.image_y + (above.below_y - above.image_y);
  ViewPictureOptions untitled = options;
  untitled.title.clear();
  std::vector<LegendItem> legend = legend_of(labels, classes, palette);
  const double legend_height = arrange(legend, below.image_width);
  const Size size{below.image_x + below.image_width + kMargin,
                  below.below_y + 16.0 + legend_height + kMargin - 4.0};
  return draw_pixels(size, [&](cairo_t* cr) {
    draw_frame(cr, above, photo, options);
    draw_frame(cr, below, coloured, untitled);
    draw_legend(cr, legend, below.image_x, below.below_y + 16.0);
  });
}

RgbImage draw_ranges(const RangeImage& ranges_m,
                     const std::string& quantity,
                     const ViewPictureOptions& options) {
  if (ranges_m.empty()) return {};
  double farthest_m = 0.0;
  bool misses = false;
  for (const float range : ranges_m.pixels()) {
    if (std::isfinite(range)) {
      farthest_m = std::max(farthest_m, static_cast<double>(range));
    } else {
      misses = true;
    }
  }
  if (farthest_m == 0.0) farthest_m = 1.0;
  RgbImage image(ranges_m.rows(), ranges_m.columns());
  std::ranges::transform(ranges_m.pixels(), image.pixels().begin(), [farthest_m](float range) {
    return std::isfinite(range) ? viridis(1.0 - range / farthest_m) : kMissing;
  });
  const Layout layout = lay_out(ranges_m.rows(), ranges_m.columns(), options);
  const Size size{layout.image_x + layout.image_width + 18.0 + kColourBarWidth + kMargin,
                  layout.below_y + (misses ? 34.0 : 0.0) + kMargin};
  return draw_pixels(size, [&](cairo_t* cr) {
    draw_frame(cr, layout, image, options);
    draw_colour_bar(cr,
                    layout.image_x + layout.image_width + 18.0,
                    layout.image_y,
                    layout.image_height,
                    0.0,
                    farthest_m,
                    quantity + " in m",
                    true);
    if (misses) {
      draw_legend(
          cr, {{kMissing, "nothing hit", {}, 0.0, 0.0}}, layout.image_x, layout.below_y + 16.0);
    }
  });
}

}  // namespace semview::picture
