// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/matrix_picture.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "semview/picture/canvas.hpp"
#include "semview/picture/colour_map.hpp"

namespace semview::picture {
namespace {

constexpr double kSquareWidth = 44.0;
constexpr double kSquareHeight = 22.0;
constexpr double kGap = 26.0;

double widest(const std::vector<std::string>& texts) {
  double width = 0.0;
  for (const std::string& text : texts) width = std::max(width, text_width(text, kSmallTextSize));
  return width;
}

double largest(const MatrixPicture& picture) {
  double size = 0.0;
  for (const Image<double>& values : picture.values) {
    for (const double value : values.pixels()) size = std::max(size, std::abs(value));
  }
  return size;
}

void draw_column_name(cairo_t* cr, double x, double y, const std::string& name) {
  cairo_save(cr);
  cairo_translate(cr, x, y);
  cairo_rotate(cr, -3.14159265358979 / 2.0);
  draw_text(cr, 0.0, 0.0, name, kSmallTextSize);
  cairo_restore(cr);
}

void draw_squares(cairo_t* cr, const Image<double>& values, double left, double top, double size) {
  for (int row = 0; row < values.rows(); ++row) {
    for (int column = 0; column < values.columns(); ++column) {
      const double value = values.at(row, column);
      const double share = size > 0.0 ? value / size : 0.0;
      const double x = left + column * kSquareWidth;
      const double y = top + row * kSquareHeight;
      set_colour(cr, diverging(share));
      fill_rectangle(cr, x, y, kSquareWidth - 1.0, kSquareHeight - 1.0);
      set_colour(cr, std::abs(share) > 0.6 ? Rgb{255, 255, 255} : kInk);
      draw_text(cr,
                x + kSquareWidth / 2.0,
                y + 0.7 * kSquareHeight,
                fmt::format("{:.2f}", value + 0.0),
                kSmallTextSize,
                Align::kCentre);
    }
  }
}

}  // namespace

RgbImage draw_matrix(const MatrixPicture& picture) {
  const double names_width = widest(picture.rows) + 10.0;
  const double names_height = widest(picture.columns) + 10.0;
  const double title_height = picture.title.empty() ? 0.0 : 2.0 * kTitleSize;
  const double top = kMargin + title_height + names_height;
  const double table_width = static_cast<double>(picture.columns.size()) * kSquareWidth;
  const double tables = static_cast<double>(picture.values.size());
  const double height = static_cast<double>(picture.rows.size()) * kSquareHeight;
  const double size = largest(picture);
  const Size paper{2.0 * kMargin + names_width + tables * table_width + (tables - 1.0) * kGap,
                   top + height + 2.0 * kMargin};
  return draw_pixels(paper, [&](cairo_t* cr) {
    set_colour(cr, kInk);
    draw_text(cr, kMargin, kMargin + kTitleSize, picture.title, kTitleSize, Align::kLeft, true);
    for (std::size_t r = 0; r < picture.rows.size(); ++r) {
      draw_text(cr,
                kMargin + names_width - 10.0,
                top + (static_cast<double>(r) + 0.7) * kSquareHeight,
                picture.rows[r],
                kSmallTextSize,
                Align::kRight);
    }
    for (std::size_t t = 0; t < picture.values.size(); ++t) {
      const double left = kMargin + names_width + static_cast<double>(t) * (table_width + kGap);
      set_colour(cr, kInk);
      for (std::size_t c = 0; c < picture.columns.size(); ++c) {
        const double x = left + (static_cast<double>(c) + 0.6) * kSquareWidth;
        draw_column_name(cr, x, top - 6.0, picture.columns[c]);
      }
      draw_squares(cr, picture.values[t], left, top, size);
      if (t >= picture.value_names.size()) continue;
      set_colour(cr, kFaintInk);
      draw_text(cr, left, top + height + kMargin, picture.value_names[t], kTextSize);
    }
  });
}

}  // namespace semview::picture
