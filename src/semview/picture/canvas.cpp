// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include <cairo/cairo-svg.h>
#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/io/text_file.hpp"
#include "semview/picture/colour_map.hpp"

namespace semview::picture {
namespace {

struct DestroySurface {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct DestroyContext {
  void operator()(cairo_t* cr) const { cairo_destroy(cr); }
};
using Surface = std::unique_ptr<cairo_surface_t, DestroySurface>;
using Context = std::unique_ptr<cairo_t, DestroyContext>;

cairo_status_t append(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

void paint_white(cairo_t* cr) {
  set_colour(cr, {255, 255, 255});
  cairo_paint(cr);
}

void select_font(cairo_t* cr, double size, bool bold) {
  cairo_select_font_face(cr,
                         "DejaVu Sans",
                         CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, size);
}

double advance(cairo_t* cr, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(cr, text.c_str(), &extents);
  return extents.x_advance;
}

std::uint32_t premultiplied(const Rgb& colour, unsigned opacity) {
  const auto part = [opacity](unsigned value) { return (value * opacity + 127U) / 255U; };
  return opacity << 24U | part(colour.r) << 16U | part(colour.g) << 8U | part(colour.b);
}

}  // namespace

RgbImage draw_pixels(const Size& size, const Drawing& drawing) {
  const int columns = static_cast<int>(std::lround(size.width));
  const int rows = static_cast<int>(std::lround(size.height));
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, columns, rows));
  SEMVIEW_CHECK(cairo_surface_status(surface.get()) == CAIRO_STATUS_SUCCESS);
  const Context cr(cairo_create(surface.get()));
  paint_white(cr.get());
  drawing(cr.get());
  cairo_surface_flush(surface.get());
  const unsigned char* const bytes = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  RgbImage image(rows, columns);
  for (int r = 0; r < rows; ++r) {
    const auto* const words =
        reinterpret_cast<const std::uint32_t*>(bytes + static_cast<std::ptrdiff_t>(r) * stride);
    for (int c = 0; c < columns; ++c) {
      image.at(r, c) = {static_cast<unsigned char>(words[c] >> 16U & 0xffU),
                        static_cast<unsigned char>(words[c] >> 8U & 0xffU),
                        static_cast<unsigned char>(words[c] & 0xffU)};
    }
  }
  return image;
}

Status write_svg(const std::filesystem::path& path, const Size& size, const Drawing& drawing) {
  std::string text;
  cairo_status_t status = CAIRO_STATUS_SUCCESS;
  {
    const Surface surface(
        cairo_svg_surface_create_for_stream(append, &text, size.width, size.height));
    cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
    const Context cr(cairo_create(surface.get()));
    paint_white(cr.get());
    drawing(cr.get());
    cairo_surface_finish(surface.get());
    status = cairo_surface_status(surface.get());
  }
  if (status != CAIRO_STATUS_SUCCESS) {
    return fail(
        ErrorCode::kInternal,
        fmt::format("{}: cannot be drawn: {}", path.string(), cairo_status_to_string(status)));
  }
  return io::write_text_file(path, text);
}

void set_colour(cairo_t* cr, const Rgb& colour, double opacity) {
  cairo_set_source_rgba(cr, colour.r / 255.0, colour.g / 255.0, colour.b / 255.0, opacity);
}

void fill_rectangle(cairo_t* cr, double x, double y, double width, double height) {
  cairo_rectangle(cr, x, y, width, height);
  cairo_fill(cr);
}

void outline_rectangle(cairo_t* cr, double x, double y, double width, double height) {
  cairo_set_line_width(cr, 1.0);
  cairo_rectangle(cr, x - 0.5, y - 0.5, width + 1.0, height + 1.0);
  cairo_stroke(cr);
}

void draw_text(
    cairo_t* cr, double x, double y, const std::string& text, double size, Align align, bool bold) {
  select_font(cr, size, bold);
  if (align == Align::kCentre) x -= advance(cr, text) / 2.0;
  if (align == Align::kRight) x -= advance(cr, text);
  cairo_move_to(cr, x, y);
  cairo_show_text(cr, text.c_str());
  cairo_new_path(cr);
}

double text_width(const std::string& text, double size, bool bold) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
  const Context cr(cairo_create(surface.get()));
  select_font(cr.get(), size, bold);
  return advance(cr.get(), text);
}

void paint_image(cairo_t* cr, const RgbImage& image, const Image<unsigned char>& opacity) {
  SEMVIEW_CHECK(opacity.empty() ||
                (opacity.rows() == image.rows() && opacity.columns() == image.columns()));
  const Surface surface(
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.columns(), image.rows()));
  SEMVIEW_CHECK(cairo_surface_status(surface.get()) == CAIRO_STATUS_SUCCESS);
  unsigned char* const bytes = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int r = 0; r < image.rows(); ++r) {
    auto* const words =
        reinterpret_cast<std::uint32_t*>(bytes + static_cast<std::ptrdiff_t>(r) * stride);
    for (int c = 0; c < image.columns(); ++c) {
      words[c] = premultiplied(image.at(r, c), opacity.empty() ? 255U : opacity.at(r, c));
    }
  }
  cairo_surface_mark_dirty(surface.get());
  double x = 1.0;
  double y = 0.0;
  cairo_user_to_device_distance(cr, &x, &y);
  cairo_set_source_surface(cr, surface.get(), 0.0, 0.0);
  const bool enlarged = std::hypot(x, y) >= 1.0;
  cairo_pattern_set_filter(cairo_get_source(cr),
                           enlarged ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
  cairo_paint(cr);
}

std::vector<double> round_ticks(double low, double high, int count) {
  if (!(high > low)) return {low};
  const double rough = (high - low) / std::max(count, 1);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * 0.999) {
      step = factor * power;
      break;
    }
  }
  std::vector<double> ticks;
  const double slack = step * 1.0e-9;
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack; ++k) {
    ticks.push_back(k * step + 0.0);
  }
  return ticks;
}

std::string tick_text(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1.0e-9)), 0, 6);
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  // A true minus sign is as wide as a plus; and there is no -0.
  if (text.find_first_not_of("-0.") == std::string::npos)
    return fmt::format("{:.{}f}", 0.0, decimals);
  return text.starts_with('-') ? "\u2212" + text.substr(1) : text;
}

void draw_colour_bar(cairo_t* cr,
                     double x,
                     double y,
                     double height,
                     double low,
                     double high,
                     const std::string& quantity,
                     bool reversed) {
  constexpr double kWidth = 16.0;
  for (double from_top = 0.0; from_top < height; from_top += 1.0) {
    const double share = 1.0 - (from_top + 0.5) / height;
    set_colour(cr, viridis(reversed ? 1.0 - share : share));
    fill_rectangle(cr, x, y + from_top, kWidth, std::min(1.0, height - from_top));
  }
  set_colour(cr, kInk);
  outline_rectangle(cr, x, y, kWidth, height);
  const std::vector<double> ticks =
      round_ticks(low, high, std::clamp(static_cast<int>(height / 46.0), 2, 8));
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
  double widest = 0.0;
  for (const double tick : ticks) {
    const double at = high > low ? y + height * (high - tick) / (high - low) : y + height / 2.0;
    set_colour(cr, kInk);
    fill_rectangle(cr, x + kWidth, at - 0.5, 5.0, 1.0);
    const std::string text = tick_text(tick, step);
    widest = std::max(widest, text_width(text, kSmallTextSize));
    draw_text(cr, x + kWidth + 9.0, at + 4.5, text, kSmallTextSize);
  }
  set_colour(cr, kFaintInk);
  cairo_save(cr);
  // Beside the numbers: long ones push it into the margin.
  const double beside =
      std::max(kColourBarWidth - 8.0, kWidth + 9.0 + widest + kSmallTextSize + 4.0);
  cairo_translate(cr, x + beside, y + height / 2.0);
  cairo_rotate(cr, -M_PI / 2.0);
  draw_text(cr, 0.0, 0.0, quantity, kSmallTextSize, Align::kCentre);
  cairo_restore(cr);
}

}  // namespace semview::picture
