// SPDX-License-Identifier: Apache-2.0
/// Pictures side by side with what a reader needs: a title, captions, a legend and a scale bar.
#pragma once

#include <string>
#include <vector>

#include "semview/geometry/image.hpp"

namespace semview::picture {

struct SheetPicture {
  struct Panel {
    std::string caption;  ///< above it
    RgbImage image;       ///< pixel for pixel
  };
  struct Mark {
    Rgb colour;
    std::string meaning;
  };
  std::string title = {};
  std::vector<Panel> panels = {};  ///< from left to right
  std::vector<Mark> marks = {};    ///< legend, below
  double pixels_per_m = 0.0;       ///< of all panels; 0: no scale bar
};

RgbImage draw_sheet(const SheetPicture& picture);

}  // namespace semview::picture
