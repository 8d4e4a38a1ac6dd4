// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/row_finder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "semview/view/view_profile.hpp"

namespace semview::raycast {
namespace {

// Enough for one row a bin at 1024 rows between ±60°; steeper cameras search within a bin.
constexpr float kMostBins = 4096.0F;

}  // namespace

RowFinder::RowFinder(const PanoramaCamera& camera) {
  const auto rows = static_cast<std::size_t>(camera.rows);
  for (int r = 0; r < camera.rows; ++r) {
    tangents_.push_back(static_cast<float>(std::tan(camera.elevation_rad(r))));
  }
  table_.rows = camera.rows;
  table_.highest = tangents_.front();
  table_.lowest = tangents_.back();
  const float width = table_.highest - table_.lowest;
  float spacing = width;
  for (std::size_t r = 1; r < rows; ++r) {
    spacing = std::min(spacing, tangents_[r - 1] - tangents_[r]);
  }
  const float bins = spacing > 0.0F ? std::min(width / spacing + 1.0F, kMostBins) : 1.0F;
  if (width > 0.0F) table_.bins_a_tangent = bins / width;

  const auto bin = [this](float tangent) { return static_cast<std::size_t>(table_.bin(tangent)); };
  std::vector<int> rows_in_bin(bin(table_.highest) + 1);
  for (const float tangent : tangents_) ++rows_in_bin[bin(tangent)];
  table_.one_row_a_bin = std::ranges::max(rows_in_bin) == 1;
  rows_above_bin_.resize(rows_in_bin.size());
  int above = 0;
  for (std::size_t b = rows_in_bin.size(); b-- > 0;) {
    rows_above_bin_[b] = static_cast<std::uint16_t>(above);
    above += rows_in_bin[b];
  }
  tangents_.push_back(-std::numeric_limits<float>::infinity());

  static_assert(kMaxPanoramaRows <= 16 * 64);
  words_ = rows <= 2 * 64 ? 2 : rows <= 3 * 64 ? 3 : 16;
  std::vector<std::uint64_t> bits(words_);
  for (std::size_t row = 0;; ++row) {
    bits_above_.insert(bits_above_.end(), bits.begin(), bits.end());
    if (row == rows) break;
    bits[row / 64] |= std::uint64_t{1} << (row % 64);
  }
}

RowTable RowFinder::table() const {
  RowTable table = table_;
  table.tangents = tangents_.data();
  table.rows_above_bin = rows_above_bin_.data();
  table.bits_above = bits_above_.data();
  return table;
}

}  // namespace semview::raycast
