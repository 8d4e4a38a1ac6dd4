// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/sheet_picture.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "semview/picture/canvas.hpp"
#include "semview/picture/legend.hpp"

namespace semview::picture {
namespace {

constexpr double kGap = 24.0;
constexpr double kKeyHeight = 40.0;  ///< of scale bar and legend, below the panels

/// About a tenth of the sheet, of a round length.
void draw_scale(cairo_t* cr, double left, double y, double pixels_per_m, double width) {
  const double metres = round_ticks(0.0, 0.25 * width / pixels_per_m, 2).back();
  const double length = metres * pixels_per_m;
  set_colour(cr, kInk);
  fill_rectangle(cr, left, y, length, 3.0);
  fill_rectangle(cr, left, y - 4.0, 1.5, 11.0);
  fill_rectangle(cr, left + length - 1.5, y - 4.0, 1.5, 11.0);
  draw_text(
      cr, left + length / 2.0, y - 6.0, fmt::format("{:g} m", metres), kTextSize, Align::kCentre);
}

}  // namespace

RgbImage draw_sheet(const SheetPicture& picture) {
  double width = 0.0;
  double height = 0.0;
  for (const SheetPicture::Panel& panel : picture.panels) {
    width += panel.image.columns() + (width > 0.0 ? kGap : 0.0);
    height = std::max(height, static_cast<double>(panel.image.rows()));
  }
  width = std::max(width, text_width(picture.title, kTitleSize, true));
  std::vector<LegendItem> legend;
  for (const SheetPicture::Mark& mark : picture.marks)
    legend.push_back({mark.colour, mark.meaning, ""});
  const double legend_height = arrange(legend, width);
  const double title_height = picture.title.empty() ? 0.0 : 1.8 * kTitleSize;
  const double top = kMargin + title_height + 1.8 * kTextSize;
  const double below = top + height;
  const Size size{width + 2.0 * kMargin, below + kKeyHeight + legend_height + kMargin};
  return draw_pixels(size, [&](cairo_t* cr) {
    set_colour(cr, kInk);
    draw_text(cr, kMargin, kMargin + kTitleSize, picture.title, kTitleSize, Align::kLeft, true);
    double left = kMargin;
    for (const SheetPicture::Panel& panel : picture.panels) {
      set_colour(cr, kInk);
      draw_text(cr, left, top - 0.6 * kTextSize, panel.caption, kTextSize);
      cairo_save(cr);
      cairo_translate(cr, left, top);
      paint_image(cr, panel.image);
      cairo_restore(cr);
      left += panel.image.columns() + kGap;
    }
    if (picture.pixels_per_m > 0.0) {
      draw_scale(cr, kMargin, below + kKeyHeight - 10.0, picture.pixels_per_m, width);
    }
    draw_legend(cr, legend, kMargin, below + kKeyHeight + 6.0);
  });
}

}  // namespace semview::picture
