// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/row_finder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace semview::raycast {
namespace {

// Enough for one row a bin at 1024 rows between ±60°; steeper cameras search within a bin.
constexpr float kMostBins = 4096.0F;

}  // namespace

RowFinder::RowFinder(const PanoramaCamera& camera) : rows_(camera.rows) {
  for (int r = 0; r < camera.rows; ++r) {
    tangents_.push_back(static_cast<float>(std::tan(camera.elevation_rad(r))));
  }
  highest_ = tangents_.front();
  lowest_ = tangents_.back();
  float spacing = highest_ - lowest_;
  for (std::size_t r = 1; r < tangents_.size(); ++r) {
    spacing = std::min(spacing, tangents_[r - 1] - tangents_[r]);
  }
  const float bins =
      spacing > 0.0F ? std::min((highest_ - lowest_) / spacing + 1.0F, kMostBins) : 1.0F;
  if (highest_ > lowest_) bins_a_tangent_ = bins / (highest_ - lowest_);

  const auto bin = [this](float tangent) {
    return static_cast<std::size_t>((tangent - lowest_) * bins_a_tangent_);
  };
  std::vector<int> rows_in_bin(bin(highest_) + 1);
  for (const float tangent : tangents_) ++rows_in_bin[bin(tangent)];
  one_row_a_bin_ = std::ranges::max(rows_in_bin) == 1;
  rows_above_bin_.resize(rows_in_bin.size());
  int above = 0;
  for (std::size_t b = rows_in_bin.size(); b-- > 0;) {
    rows_above_bin_[b] = static_cast<std::uint16_t>(above);
    above += rows_in_bin[b];
  }
  tangents_.push_back(-std::numeric_limits<float>::infinity());
}

}  // namespace semview::raycast
