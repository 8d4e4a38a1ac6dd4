// SPDX-License-Identifier: Apache-2.0
/// Cairo for the drawings of this module; no other module includes it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <cairo/cairo.h>

#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"

namespace semview::picture {

struct Size {
  double width = 0.0;
  double height = 0.0;
};

/// One drawing, made for pixels and for SVG alike.
using Drawing = std::function<void(cairo_t*)>;

/// Draws on white paper.
RgbImage draw_pixels(const Size& size, const Drawing& drawing);

/// @errors kUnavailable: the file cannot be written.
Status write_svg(const std::filesystem::path& path, const Size& size, const Drawing& drawing);

enum class Align { kLeft, kCentre, kRight };

inline constexpr double kTitleSize = 19.0;
inline constexpr double kTextSize = 14.0;
inline constexpr double kSmallTextSize = 12.0;
inline constexpr double kMargin = 22.0;
inline constexpr Rgb kInk{38, 42, 48};
inline constexpr Rgb kFaintInk{110, 116, 124};
inline constexpr Rgb kMissing{206, 208, 212};  ///< where there is no value

void set_colour(cairo_t* cr, const Rgb& colour, double opacity = 1.0);
void fill_rectangle(cairo_t* cr, double x, double y, double width, double height);
void outline_rectangle(cairo_t* cr, double x, double y, double width, double height);

/// Text with its baseline at `y`; measuring needs no drawing.
void draw_text(cairo_t* cr,
               double x,
               double y,
               const std::string& text,
               double size,
               Align align = Align::kLeft,
               bool bold = false);
double text_width(const std::string& text, double size, bool bold = false);

/// Fills the unit square of the current transform scaled by (columns, rows) with `image`, pixel
/// edges on whole numbers; enlarged pixels stay sharp. `opacity` in [0, 1], a value a pixel, or
/// empty for opaque.
void paint_image(cairo_t* cr, const RgbImage& image, const Image<unsigned char>& opacity = {});

/// Round numbers (1, 2 or 5 times a power of ten apart) within [low, high], about `count` of them.
std::vector<double> round_ticks(double low, double high, int count);
/// A tick's number with as many decimals as its step needs.
std::string tick_text(double value, double step);

/// A vertical bar of viridis colours from `low` (at the bottom) to `high`, ticks on its right.
/// `reversed` puts yellow at the low end.
void draw_colour_bar(cairo_t* cr,
                     double x,
                     double y,
                     double height,
                     double low,
                     double high,
                     const std::string& quantity,
                     bool reversed);
inline constexpr double kColourBarWidth = 80.0;  ///< with its numbers

}  // namespace semview::picture
