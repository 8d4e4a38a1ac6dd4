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
constexpr double kCaption = 24.0;  ///< a table's name, above those of its columns
/// Tables that are wider stand below each other.
constexpr double kPageWidth = 1200.0;
constexpr double kScaleWidth = 240.0;
constexpr double kScaleHeight = 12.0;
constexpr double kScaleNumber = 40.0;  ///< what its numbers need at either side

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

/// What stands where.
struct Layout {
  explicit Layout(const MatrixPicture& picture)
      : names_width(std::max(widest(picture.rows), widest({picture.row_axis})) + 10.0),
        names_height(widest(picture.columns) + 10.0),
        table_width(static_cast<double>(picture.columns.size()) * kSquareWidth),
        table_height(static_cast<double>(picture.rows.size()) * kSquareHeight),
        title_height(picture.title.empty() ? 0.0 : 2.0 * kTitleSize) {
    const double room = kPageWidth - 2.0 * kMargin - names_width + kGap;
    const auto fit = static_cast<std::size_t>(std::max(1.0, room / (table_width + kGap)));
    a_line = std::clamp<std::size_t>(picture.values.size(), 1, fit);
    lines = (picture.values.size() + a_line - 1) / a_line;
  }

  double left(std::size_t table) const {
    return kMargin + names_width + static_cast<double>(table % a_line) * (table_width + kGap);
  }
  /// Of the squares.
  double top(std::size_t line) const {
    return kMargin + title_height + static_cast<double>(line) * line_height() + kCaption +
           names_height;
  }
  double line_height() const { return kCaption + names_height + table_height + kGap; }
  Size paper() const {
    const double tables = names_width + static_cast<double>(a_line) * (table_width + kGap) - kGap;
    return {2.0 * kMargin + std::max(tables, kScaleWidth + 2.0 * kScaleNumber),
            bottom() + kScaleHeight + 1.5 * kTextSize + kMargin};
  }
  double bottom() const {
    return kMargin + title_height + static_cast<double>(lines) * line_height();
  }

  double names_width;
  double names_height;
  double table_width;
  double table_height;
  double title_height;
  std::size_t a_line = 1;
  std::size_t lines = 1;
};

/// The names of rows, columns and axes that a line of tables shares.
void draw_names(cairo_t* cr, const MatrixPicture& picture, const Layout& at, std::size_t line) {
  const double right = kMargin + at.names_width - 10.0;
  const double top = at.top(line);
  set_colour(cr, kFaintInk);
  draw_text(cr, right, top - 8.0, picture.row_axis, kSmallTextSize, Align::kRight);
  draw_text(
      cr, right, top - at.names_height + 6.0, picture.column_axis, kSmallTextSize, Align::kRight);
  set_colour(cr, kInk);
  for (std::size_t r = 0; r < picture.rows.size(); ++r) {
    const double y = top + (static_cast<double>(r) + 0.7) * kSquareHeight;
    draw_text(cr, right, y, picture.rows[r], kSmallTextSize, Align::kRight);
  }
}

void draw_table(
    cairo_t* cr, const MatrixPicture& picture, const Layout& at, std::size_t table, double size) {
  const double left = at.left(table);
  const double top = at.top(table / at.a_line);
  set_colour(cr, kInk);
  if (table < picture.value_names.size()) {
    draw_text(cr, left, top - at.names_height - 8.0, picture.value_names[table], kTextSize);
  }
  for (std::size_t c = 0; c < picture.columns.size(); ++c) {
    const double x = left + (static_cast<double>(c) + 0.6) * kSquareWidth;
    draw_column_name(cr, x, top - 6.0, picture.columns[c]);
  }
  draw_squares(cr, picture.values[table], left, top, size);
}

/// The colours from -size to size.
void draw_scale(cairo_t* cr, const Layout& at, double size) {
  constexpr int kSteps = 61;
  const double left = kMargin + kScaleNumber;
  const double top = at.bottom();
  for (int i = 0; i < kSteps; ++i) {
    set_colour(cr, diverging(2.0 * i / (kSteps - 1) - 1.0));
    fill_rectangle(
        cr, left + i * kScaleWidth / kSteps, top, kScaleWidth / kSteps + 0.5, kScaleHeight);
  }
  set_colour(cr, kInk);
  outline_rectangle(cr, left, top, kScaleWidth, kScaleHeight);
  const double below = top + kScaleHeight + kTextSize;
  const std::string highest = fmt::format("{:.2g}", size);
  draw_text(cr, left, below, "against -" + highest, kSmallTextSize, Align::kCentre);
  draw_text(cr, left + kScaleWidth / 2.0, below, "0", kSmallTextSize, Align::kCentre);
  draw_text(cr, left + kScaleWidth, below, "for +" + highest, kSmallTextSize, Align::kCentre);
}

}  // namespace

RgbImage draw_matrix(const MatrixPicture& picture) {
  const Layout at(picture);
  const double size = largest(picture);
  return draw_pixels(at.paper(), [&](cairo_t* cr) {
    set_colour(cr, kInk);
    draw_text(cr, kMargin, kMargin + kTitleSize, picture.title, kTitleSize, Align::kLeft, true);
    for (std::size_t line = 0; line < at.lines; ++line) draw_names(cr, picture, at, line);
    for (std::size_t t = 0; t < picture.values.size(); ++t) draw_table(cr, picture, at, t, size);
    draw_scale(cr, at, size);
  });
}

}  // namespace semview::picture
