// SPDX-License-Identifier: Apache-2.0
/// A panorama or photograph with its axes, as the pictures of views have it. Private to this
/// module.
#pragma once

#include <vector>

#include "semview/picture/canvas.hpp"
#include "semview/picture/legend.hpp"
#include "semview/picture/view_picture.hpp"

namespace semview::picture {

/// Where the parts of a picture stand.
struct Layout {
  double image_x = kMargin;
  double image_y = kMargin;
  double zoom = 1.0;
  double image_width = 0.0;
  double image_height = 0.0;
  double below_y = 0.0;  ///< under the image and its axis
};

Layout lay_out(int rows, int columns, const ViewPictureOptions& options);

/// Title, image, outline and axes.
void draw_frame(cairo_t* cr,
                const Layout& layout,
                const RgbImage& image,
                const ViewPictureOptions& options);

/// The classes that occur, largest first, with their share of the pixels.
std::vector<LegendItem> legend_of(const LabelImage& labels,
                                  const ClassTable& classes,
                                  const ClassPalette& palette);

RgbImage coloured(const LabelImage& labels, const ClassPalette& palette);

}  // namespace semview::picture
