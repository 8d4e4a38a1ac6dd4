// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/legend.hpp"

namespace semview::picture {

double arrange(std::vector<LegendItem>& items, double width) {
  double x = 0.0;
  double y = 0.0;
  for (LegendItem& item : items) {
    const double item_width =
        24.0 + text_width(item.name, kTextSize) + 6.0 + text_width(item.share, kSmallTextSize);
    if (x > 0.0 && x + item_width > width) {
      x = 0.0;
      y += 26.0;
    }
    item.x = x;
    item.y = y;
    x += item_width + 26.0;
  }
  return y + 20.0;
}

void draw_legend(cairo_t* cr, const std::vector<LegendItem>& items, double x, double y) {
  for (const LegendItem& item : items) {
    set_colour(cr, item.colour);
    fill_rectangle(cr, x + item.x, y + item.y, 16.0, 16.0);
    set_colour(cr, kInk, 0.55);
    outline_rectangle(cr, x + item.x, y + item.y, 16.0, 16.0);
    set_colour(cr, kInk);
    draw_text(cr, x + item.x + 24.0, y + item.y + 13.0, item.name, kTextSize);
    set_colour(cr, kFaintInk);
    draw_text(cr,
              x + item.x + 24.0 + text_width(item.name, kTextSize) + 6.0,
              y + item.y + 13.0,
              item.share,
              kSmallTextSize);
  }
}

}  // namespace semview::picture
