// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/view_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "semview/core/check.hpp"
#include "semview/picture/canvas.hpp"
#include "semview/picture/colour_map.hpp"
#include "semview/picture/panorama_frame.hpp"

namespace semview::picture {
namespace {

/// Half of either colour.
Rgb mixed(const Rgb& a, const Rgb& b) {
  const auto half = [](int x, int y) { return static_cast<unsigned char>((x + y) / 2); };
  return {half(a.r, b.r), half(a.g, b.g), half(a.b, b.b)};
}

}  // namespace

RgbImage draw_labels(const LabelImage& labels,
                     const ClassTable& classes,
                     const ClassPalette& palette,
                     const ViewPictureOptions& options) {
  if (labels.empty()) return {};
  const RgbImage image = coloured(labels, palette);
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
  RgbImage tinted(photo.rows(), photo.columns());
  for (std::size_t i = 0; i < tinted.pixels().size(); ++i) {
    tinted.pixels()[i] = mixed(photo.pixels()[i], palette[labels.pixels()[i]]);
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
    draw_frame(cr, below, tinted, untitled);
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
