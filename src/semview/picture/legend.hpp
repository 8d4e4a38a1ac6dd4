// SPDX-License-Identifier: Apache-2.0
/// Colours and what they stand for, in lines under a picture. Private to this module.
#pragma once

#include <string>
#include <vector>

#include "semview/picture/canvas.hpp"

namespace semview::picture {

struct LegendItem {
  Rgb colour;
  std::string name;
  std::string share;  ///< in small print behind the name; may be empty
  double x = 0.0;     ///< place in the legend, set by `arrange`
  double y = 0.0;
};

/// Sets the items in lines that fit `width`; returns their height.
double arrange(std::vector<LegendItem>& items, double width);

void draw_legend(cairo_t* cr, const std::vector<LegendItem>& items, double x, double y);

}  // namespace semview::picture
