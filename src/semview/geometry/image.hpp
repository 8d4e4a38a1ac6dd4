// SPDX-License-Identifier: Apache-2.0
/// A row-major image.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "semview/core/check.hpp"

namespace semview {

/// `rows` × `columns` pixels; row 0 is the top of the picture.
template <typename T>
class Image {
 public:
  Image() = default;
  Image(int rows, int columns, const T& value = T{})
      : rows_(rows),
        columns_(columns),
        pixels_(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns), value) {
    SEMVIEW_CHECK(rows >= 0 && columns >= 0);
  }

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  bool empty() const { return pixels_.empty(); }

  T& at(int row, int column) { return pixels_[index(row, column)]; }
  const T& at(int row, int column) const { return pixels_[index(row, column)]; }
  std::span<T> row(int r) { return std::span(pixels_).subspan(index(r, 0), width()); }
  std::span<const T> row(int r) const { return std::span(pixels_).subspan(index(r, 0), width()); }
  std::span<T> pixels() { return pixels_; }
  std::span<const T> pixels() const { return pixels_; }

  bool operator==(const Image&) const = default;

 private:
  std::size_t width() const { return static_cast<std::size_t>(columns_); }
  std::size_t index(int row, int column) const {
    SEMVIEW_ASSERT(row >= 0 && row < rows_ && column >= 0 && (column < columns_ || columns_ == 0));
    return static_cast<std::size_t>(row) * width() + static_cast<std::size_t>(column);
  }

  int rows_ = 0;
  int columns_ = 0;
  std::vector<T> pixels_;
};

/// An opaque sRGB colour.
struct Rgb {
  unsigned char r = 0;
  unsigned char g = 0;
  unsigned char b = 0;

  auto operator<=>(const Rgb&) const = default;
};

using RgbImage = Image<Rgb>;

}  // namespace semview
