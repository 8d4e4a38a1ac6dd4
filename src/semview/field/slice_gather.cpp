// SPDX-License-Identifier: Apache-2.0
#include "semview/field/slice_gather.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "semview/field/slice_gather.cpp"
#include <hwy/foreach_target.h>  // compiles what follows once a target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace semview::field::HWY_NAMESPACE {

// Lanes are poses. All voxels of a slice are taken for the same few poses before the next: the
// poses stay in registers, the slice in the cache. No product may be fused with a sum: the cell of
// a point near an edge would depend on the target.

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<float> kFloats{};
constexpr hn::RebindToSigned<decltype(kFloats)> kInts{};
using Floats = hn::Vec<decltype(kFloats)>;
using Ints = hn::Vec<decltype(kInts)>;

template <int kVectors>
HWY_INLINE void add_voxels(const LossSlice& slice,
                           std::span<const SliceVoxel> voxels,
                           const PoseLanes& poses,
                           std::size_t pose,
                           std::int64_t* sums) {
  const std::size_t lanes = hn::Lanes(kFloats);
  Floats x[kVectors];
  Floats y[kVectors];
  Floats cosine[kVectors];
  Floats sine[kVectors];
  Ints sum[kVectors];
  for (int i = 0; i < kVectors; ++i) {
    const std::size_t first = pose + static_cast<std::size_t>(i) * lanes;
    x[i] = hn::LoadU(kFloats, &poses.x_cells[first]);
    y[i] = hn::LoadU(kFloats, &poses.y_cells[first]);
    cosine[i] = hn::LoadU(kFloats, &poses.cos_yaw[first]);
    sine[i] = hn::LoadU(kFloats, &poses.sin_yaw[first]);
    sum[i] = hn::Zero(kInts);
  }
  const Floats zero = hn::Zero(kFloats);
  const Floats last_column = hn::Set(kFloats, static_cast<float>(slice.columns - 1));
  const Floats last_row = hn::Set(kFloats, static_cast<float>(slice.rows - 1));
  const Ints columns = hn::Set(kInts, slice.columns);
  const Ints one = hn::Set(kInts, 1);
  const Ints low_half = hn::Set(kInts, 0xFFFF);
  for (const SliceVoxel& voxel : voxels) {
    const Floats ahead = hn::Set(kFloats, voxel.x_cells);
    const Floats aside = hn::Set(kFloats, voxel.y_cells);
    const Ints count = hn::Set(kInts, voxel.count);
    for (int i = 0; i < kVectors; ++i) {
      const Floats u = hn::Add(x[i], hn::Sub(hn::Mul(cosine[i], ahead), hn::Mul(sine[i], aside)));
      const Floats v = hn::Add(y[i], hn::Add(hn::Mul(sine[i], ahead), hn::Mul(cosine[i], aside)));
      const Ints column = hn::ConvertTo(kInts, hn::Min(hn::Max(u, zero), last_column));
      const Ints row = hn::ConvertTo(kInts, hn::Min(hn::Max(v, zero), last_row));
      const Ints cell = hn::Add(hn::Mul(row, columns), column);
      const Ints word = hn::GatherIndex(kInts, slice.words.data(), hn::ShiftRight<1>(cell));
      const Ints half = hn::ShiftLeft<4>(hn::And(cell, one));
      const Ints loss = hn::And(hn::Shr(word, half), low_half);
      sum[i] = hn::Add(sum[i], hn::Mul(loss, count));
    }
  }
  alignas(64) std::int32_t stored[hn::MaxLanes(kInts)];
  for (int i = 0; i < kVectors; ++i) {
    hn::Store(sum[i], kInts, stored);
    std::int64_t* const to = sums + pose + static_cast<std::size_t>(i) * lanes;
    for (std::size_t k = 0; k < lanes; ++k) to[k] += static_cast<std::uint32_t>(stored[k]);
  }
}

HWY_ATTR void add_losses_of(const LossSlice& slice,
                            std::span<const SliceVoxel> voxels,
                            const PoseLanes& poses,
                            std::size_t begin,
                            std::size_t end,
                            std::int64_t* sums) {
  static_assert(PoseLanes::kPad % (2 * hn::MaxLanes(kFloats)) == 0);
  const std::size_t step = 2 * hn::Lanes(kFloats);
  for (std::size_t pose = begin; pose < end; pose += step) {
    add_voxels<2>(slice, voxels, poses, pose, sums);
  }
}

}  // namespace semview::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace semview::field {

HWY_EXPORT(add_losses_of);

LossSlice::LossSlice(int columns_of_grid, int rows_of_grid)
    : columns(columns_of_grid),
      rows(rows_of_grid),
      words((static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) + 1) / 2) {}

std::uint16_t LossSlice::at(std::size_t cell) const {
  return static_cast<std::uint16_t>(static_cast<std::uint32_t>(words[cell / 2]) >> (cell % 2 * 16));
}

void LossSlice::set(std::size_t cell, std::uint16_t loss) {
  const std::uint32_t shift = cell % 2 * 16;
  const std::uint32_t other = static_cast<std::uint32_t>(words[cell / 2]) & ~(0xFFFFU << shift);
  words[cell / 2] = static_cast<std::int32_t>(other | static_cast<std::uint32_t>(loss) << shift);
}

PoseLanes::PoseLanes(std::size_t count) {
  const std::size_t padded = (count + kPad - 1) / kPad * kPad;
  for (std::vector<float>* lane : {&x_cells, &y_cells, &cos_yaw, &sin_yaw}) lane->resize(padded);
}

void add_losses(const LossSlice& slice,
                std::span<const SliceVoxel> voxels,
                const PoseLanes& poses,
                std::size_t begin,
                std::size_t end,
                std::span<std::int64_t> sums) {
  HWY_DYNAMIC_DISPATCH(add_losses_of)(slice, voxels, poses, begin, end, sums.data());
}

std::int64_t loss_of_pose(const LossSlice& slice,
                          std::span<const SliceVoxel> voxels,
                          const PoseLanes& poses,
                          std::size_t pose) {
  const float x = poses.x_cells[pose];
  const float y = poses.y_cells[pose];
  const float cosine = poses.cos_yaw[pose];
  const float sine = poses.sin_yaw[pose];
  std::int64_t sum = 0;
  for (const SliceVoxel& voxel : voxels) {
    const float u = x + (cosine * voxel.x_cells - sine * voxel.y_cells);
    const float v = y + (sine * voxel.x_cells + cosine * voxel.y_cells);
    const int column = static_cast<int>(std::clamp(u, 0.0F, static_cast<float>(slice.columns - 1)));
    const int row = static_cast<int>(std::clamp(v, 0.0F, static_cast<float>(slice.rows - 1)));
    const std::size_t cell =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(slice.columns) +
        static_cast<std::size_t>(column);
    sum += static_cast<std::int64_t>(slice.at(cell)) * voxel.count;
  }
  return sum;
}

}  // namespace semview::field
#endif  // HWY_ONCE
