// SPDX-License-Identifier: Apache-2.0
/// Exact Euclidean distances to the nearest marked cell of a grid.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "semview/geometry/image.hpp"

namespace semview::field {

/// A dense box of voxels, x fastest, then y, then z.
struct Box {
  int nx = 0;
  int ny = 0;
  int nz = 0;

  std::size_t size() const {
    return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) *
           static_cast<std::size_t>(nz);
  }
  std::size_t index(int x, int y, int z) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(nx) *
               (static_cast<std::size_t>(y) +
                static_cast<std::size_t>(ny) * static_cast<std::size_t>(z));
  }
};

/// Squared distance, in cells, from each cell's centre to that of the nearest cell that is marked
/// (not 0); infinity where none is.
///
/// Exact: by the lower envelope of parabolas, one axis after the other.
/// @cost O(cells)
/// @source Felzenszwalb and Huttenlocher, Distance Transforms of Sampled Functions, 2012.
Image<float> squared_distances(const Image<std::uint8_t>& marked);

/// The same in a box. `marked` has box.size() cells.
std::vector<float> squared_distances(std::span<const std::uint8_t> marked, const Box& box);

}  // namespace semview::field
