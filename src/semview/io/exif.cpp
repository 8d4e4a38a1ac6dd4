// SPDX-License-Identifier: Apache-2.0
#include "semview/io/exif.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

namespace semview::io {
namespace {

constexpr std::array<unsigned char, 6> kExif{'E', 'x', 'i', 'f', 0, 0};
constexpr std::uint32_t kOrientationTag = 0x0112;
constexpr std::uint32_t kTypeShort = 3;
constexpr std::size_t kEntryBytes = 12;

/// Numbers of a TIFF block in its own byte order; none past its end.
class Tiff {
 public:
  explicit Tiff(std::span<const unsigned char> bytes) : bytes_(bytes) {
    little_ = bytes.size() > 1 && bytes[0] == 'I' && bytes[1] == 'I';
  }

  std::optional<std::uint32_t> number(std::size_t at, std::size_t bytes) const {
    if (at > bytes_.size() || bytes_.size() - at < bytes) return std::nullopt;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) {
      value = value << 8U | bytes_[at + (little_ ? bytes - 1 - i : i)];
    }
    return value;
  }

 private:
  std::span<const unsigned char> bytes_;
  bool little_ = false;
};

}  // namespace

Orientation exif_orientation(std::span<const unsigned char> app1) {
  constexpr Orientation kNone = Orientation::kUpright;
  if (app1.size() < kExif.size() || !std::equal(kExif.begin(), kExif.end(), app1.begin())) {
    return kNone;
  }
  const Tiff tiff(app1.subspan(kExif.size()));
  const std::optional<std::uint32_t> directory = tiff.number(4, 4);
  if (tiff.number(2, 2) != 42U || !directory) return kNone;
  const std::uint32_t entries = tiff.number(*directory, 2).value_or(0);
  for (std::uint32_t i = 0; i < entries; ++i) {
    const std::size_t entry = std::size_t{*directory} + 2 + i * kEntryBytes;
    const std::optional<std::uint32_t> tag = tiff.number(entry, 2);
    if (!tag) return kNone;
    if (*tag != kOrientationTag) continue;
    const std::uint32_t value = tiff.number(entry + 8, 2).value_or(0);
    if (tiff.number(entry + 2, 2) != kTypeShort || value < 1 || value > 8) return kNone;
    return static_cast<Orientation>(value);
  }
  return kNone;
}

RgbImage upright(RgbImage stored, Orientation orientation) {
  if (orientation == Orientation::kUpright) return stored;
  const bool turned = orientation >= Orientation::kTransposed;
  const int rows = turned ? stored.columns() : stored.rows();
  const int columns = turned ? stored.rows() : stored.columns();
  const int last_row = stored.rows() - 1;
  const int last_column = stored.columns() - 1;
  const auto source = [&](int r, int c) -> std::pair<int, int> {
    switch (orientation) {
      case Orientation::kMirrored:
        return {r, last_column - c};
      case Orientation::kUpsideDown:
        return {last_row - r, last_column - c};
      case Orientation::kMirroredUpsideDown:
        return {last_row - r, c};
      case Orientation::kTransposed:
        return {c, r};
      case Orientation::kTurnedLeft:
        return {last_row - c, r};
      case Orientation::kAntiTransposed:
        return {last_row - c, last_column - r};
      case Orientation::kTurnedRight:
        return {c, last_column - r};
      default:
        return {r, c};
    }
  };
  RgbImage image(rows, columns);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const auto [row, column] = source(r, c);
      image.at(r, c) = stored.at(row, column);
    }
  }
  return image;
}

}  // namespace semview::io
