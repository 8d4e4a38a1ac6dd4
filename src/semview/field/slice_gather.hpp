// SPDX-License-Identifier: Apache-2.0
/// The inner loops of the field's likelihood: the voxels of one slice at many poses. Inside the
/// module only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace semview::field {

/// Losses of one class at one height, a cell each, in units of 1 / kUnitsPerNat. What lies beyond
/// has the loss of the nearest cell. Two cells a word, the first in the lower half.
struct LossSlice {
  int columns = 0;
  int rows = 0;
  std::vector<std::int32_t> words;

  /// All losses 0.
  LossSlice(int columns_of_grid, int rows_of_grid);

  /// Of cell row · columns + column.
  std::uint16_t at(std::size_t cell) const;
  void set(std::size_t cell, std::uint16_t loss);
  std::size_t bytes() const { return words.size() * sizeof(std::int32_t); }
};

/// Where a voxel is in frame `base`, in cells, and how many pixels it stands for.
struct SliceVoxel {
  float x_cells = 0.0F;
  float y_cells = 0.0F;
  std::int32_t count = 0;
};

/// Pixels that voxels given in one call may stand for, so that the sum of their losses fits 32
/// bits.
inline constexpr std::uint32_t kMaxPixelsAtOnce = 65536;

/// Poses one beside the other, in the slices' cells: cell (column, row) covers
/// [column, column + 1) × [row, row + 1).
struct PoseLanes {
  /// The arrays' lengths are multiples of this: more lanes than any instruction takes at once.
  static constexpr std::size_t kPad = 128;

  std::vector<float> x_cells;
  std::vector<float> y_cells;
  std::vector<float> cos_yaw;
  std::vector<float> sin_yaw;

  /// Room for `count` poses and some to spare, all 0.
  explicit PoseLanes(std::size_t count);
};

/// Adds what the voxels lose at each of the poses [begin, end) to its sum, with the widest vector
/// instructions that this machine has; the numbers are the same with any. `begin` and `end` are
/// multiples of `PoseLanes::kPad`, `sums` are of all poses.
void add_losses(const LossSlice& slice,
                std::span<const SliceVoxel> voxels,
                const PoseLanes& poses,
                std::size_t begin,
                std::size_t end,
                std::span<std::int64_t> sums);

/// The same for one pose, voxel by voxel.
std::int64_t loss_of_pose(const LossSlice& slice,
                          std::span<const SliceVoxel> voxels,
                          const PoseLanes& poses,
                          std::size_t pose);

}  // namespace semview::field
