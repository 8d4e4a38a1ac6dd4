// SPDX-License-Identifier: Apache-2.0
/// What an observation and a view have in common, and what each pixel of it counts.
#pragma once

#include <string>

#include "semview/geometry/image.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/picture/class_palette.hpp"
#include "semview/view/column_view.hpp"

namespace semview::picture {

/// Three panoramas of one size.
struct ExplanationPicture {
  LabelImage observed;  ///< ids of `observed_classes`
  ClassTable observed_classes;
  LabelImage view;  ///< ids of `map_classes`
  ClassTable map_classes;
  Image<double> contributions;  ///< what each pixel adds to the score
  PanoramaCamera camera;
  std::string title = {};
  int min_width_px = 1080;
};

/// One above the other: what was observed, what the map shows, and what raised the score (blue) and
/// lowered it (red), white at zero, equally strong colours for equal sizes of both signs; pixels
/// that do not count are grey. Classes of the two tables that share a name share a colour.
RgbImage draw_explanation(const ExplanationPicture& picture);

}  // namespace semview::picture
