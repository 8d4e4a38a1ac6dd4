// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/explanation_picture.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/picture/colour_map.hpp"
#include "semview/picture/panorama_frame.hpp"

namespace semview::picture {
namespace {

constexpr double kHeading = 24.0;  // room for the line above each panorama
constexpr Rgb kNotCounted = kMissing;

/// The observer's palette in which names that the map knows have the map's colours.
ClassPalette observed_palette(const ExplanationPicture& picture, const ClassPalette& map) {
  ClassPalette palette = ClassPalette::for_classes(picture.observed_classes);
  for (std::size_t i = 0; i < picture.observed_classes.names().size(); ++i) {
    const auto same = picture.map_classes.id(picture.observed_classes.names()[i]);
    if (same) palette.set(static_cast<ClassId>(i + 1), map[*same]);
  }
  return palette;
}

RgbImage contribution_image(const ExplanationPicture& picture, double largest) {
  RgbImage image(picture.view.rows(), picture.view.columns());
  for (std::size_t i = 0; i < image.pixels().size(); ++i) {
    const ClassId label = picture.observed.pixels()[i];
    const bool counts = label != kNoHit && label != kUnknown;
    const double value = picture.contributions.pixels()[i];
    image.pixels()[i] = counts ? diverging(largest > 0.0 ? value / largest : 0.0) : kNotCounted;
  }
  return image;
}

std::vector<LegendItem> scale_of(double largest) {
  const auto item = [&](double share, const char* what) {
    return LegendItem{
        diverging(share), fmt::format("{:+.2g}{}", share * largest, what), {}, 0.0, 0.0};
  };
  return {item(1.0, " raises the score"),
          item(0.5, ""),
          LegendItem{diverging(0.0), "0", {}, 0.0, 0.0},
          item(-0.5, ""),
          item(-1.0, " lowers it"),
          LegendItem{kNotCounted, "not observed", {}, 0.0, 0.0}};
}

/// A panorama with a line above and a legend below it.
struct Panel {
  const char* heading = "";
  RgbImage image;
  std::vector<LegendItem> legend;
  Layout layout;
};

}  // namespace

RgbImage draw_explanation(const ExplanationPicture& picture) {
  const auto fits = [&](const auto& image) {
    return image.rows() == picture.camera.rows && image.columns() == picture.camera.columns;
  };
  SEMVIEW_CHECK(fits(picture.observed) && fits(picture.view) && fits(picture.contributions));
  double largest = 0.0;
  for (const double value : picture.contributions.pixels()) {
    largest = std::max(largest, std::abs(value));
  }
  const ClassPalette map = ClassPalette::for_classes(picture.map_classes);
  const ClassPalette observed = observed_palette(picture, map);
  std::vector<Panel> panels{{"observed",
                             coloured(picture.observed, observed),
                             legend_of(picture.observed, picture.observed_classes, observed),
                             {}},
                            {"the map, from there",
                             coloured(picture.view, map),
                             legend_of(picture.view, picture.map_classes, map),
                             {}},
                            {"what each pixel adds: its weight",
                             contribution_image(picture, largest),
                             scale_of(largest),
                             {}}};
  ViewPictureOptions options{{}, picture.camera, picture.min_width_px};
  double y = kMargin + (picture.title.empty() ? 0.0 : 32.0);
  for (Panel& panel : panels) {
    panel.layout = lay_out(picture.camera.rows, picture.camera.columns, options);
    const double down = y + kHeading - panel.layout.image_y;
    panel.layout.image_y += down;
    panel.layout.below_y += down;
    y = panel.layout.below_y + 16.0 + arrange(panel.legend, panel.layout.image_width) + 14.0;
  }
  const Layout& first = panels.front().layout;
  const Size size{first.image_x + first.image_width + kMargin, y + kMargin - 14.0};
  return draw_pixels(size, [&](cairo_t* cr) {
    set_colour(cr, kInk);
    draw_text(cr, first.image_x, kMargin + 14.0, picture.title, kTitleSize, Align::kLeft, true);
    for (const Panel& panel : panels) {
      set_colour(cr, kInk);
      draw_text(cr, panel.layout.image_x, panel.layout.image_y - 8.0, panel.heading, kTextSize);
      draw_frame(cr, panel.layout, panel.image, options);
      draw_legend(cr, panel.legend, panel.layout.image_x, panel.layout.below_y + 16.0);
    }
  });
}

}  // namespace semview::picture
