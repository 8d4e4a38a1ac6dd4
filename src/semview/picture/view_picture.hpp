// SPDX-License-Identifier: Apache-2.0
/// Label and range images as people see them: coloured, with legend, axes and title.
#pragma once

#include <optional>
#include <string>

#include "semview/geometry/image.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/picture/class_palette.hpp"
#include "semview/view/column_view.hpp"

namespace semview::picture {

struct ViewPictureOptions {
  std::string title = {};  ///< one line above the image; nothing if empty
  /// Of a panorama: azimuth and elevation in degrees along the edges.
  std::optional<PanoramaCamera> axes = {};
  int min_width_px = 1080;  ///< small images are enlarged by a whole factor to at least this
};

/// The classes in their colours; the legend lists those that occur, largest first, with their
/// share of the pixels.
RgbImage draw_labels(const LabelImage& labels,
                     const ClassTable& classes,
                     const ClassPalette& palette,
                     const ViewPictureOptions& options = {});

/// A photograph, and below it the same with the classes' colours over it and a legend as of
/// `draw_labels`. Unknown pixels are greyed.
/// @param photo  of the size of `labels`
RgbImage draw_overlay(const RgbImage& photo,
                      const LabelImage& labels,
                      const ClassTable& classes,
                      const ClassPalette& palette,
                      const ViewPictureOptions& options = {});

/// Distances with a colour bar in metres; near is bright, +∞ is drawn in grey. `quantity` stands
/// beside the bar: "range" for panoramas, "depth" for pinhole images.
RgbImage draw_ranges(const RangeImage& ranges_m,
                     const std::string& quantity,
                     const ViewPictureOptions& options = {});

}  // namespace semview::picture
