// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/run_sweep.hpp"

#include <algorithm>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "semview/similarity/run_sweep.cpp"
#include <hwy/foreach_target.h>  // compiles what follows once a target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace semview::similarity::HWY_NAMESPACE {

// Lanes are groups of observed columns. Group g of the observation meets group q of the view at
// heading g - q (mod 120), so the sums wander by one lane from one q to the next. They are kept in
// memory at [lane - q + 120], unfolded, and loaded and stored once for the columns of a group.
//
// A column's sum fits 16 bits, the sum of many does not. Two 16-bit sums stand for one of 32:
// `low` adds up the columns' sums and may wrap; `high` adds up floor(sum / 256). With at most 255
// columns, high is within ±32640, and the whole is 256 · high + a rest in [0, 255 · 255], which low
// tells since it is less than 65536. (Widening each column's sum takes twice the instructions.)

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<std::int16_t> kTag{};
constexpr int kLanes = static_cast<int>(hn::MaxLanes(kTag));
using Lanes = hn::Vec<decltype(kTag)>;

constexpr int kHeadings = PoseGrid::kHeadings;
constexpr int kMostColumns = 255;
/// The view's groups are taken from both ends of the circle in turn, each half with sums of its
/// own: a load of what the last step has stored one lane beside would wait for it (5.1 → 4.1 us).
constexpr int kHalf = kHeadings / 2;
constexpr int kUnfolded = 256;

/// Sums of one half of the view.
struct UnfoldedSums {
  alignas(64) std::int16_t low[kUnfolded] = {};
  alignas(64) std::int16_t high[kUnfolded] = {};

  HWY_INLINE void add_to(std::int32_t* sums) const {
    for (int i = 0; i < kUnfolded; ++i) {
      const std::int32_t high256 = 256 * high[i];
      sums[i] += high256 + static_cast<std::uint16_t>(low[i] - high256);
    }
  }
};

/// What of a table the loop over runs needs.
struct Strides {
  std::size_t row;
  std::size_t label;
  std::size_t residue;
  int rows;
  int residues;

  explicit Strides(const PrefixTable& table)
      : row(table.row_stride()),
        label(table.class_stride()),
        residue(table.width()),
        rows(table.rows()),
        residues(table.residues()) {}
};

/// Adds the view's columns of one group, whose runs begin at `run`, to sums at `low` and `high`.
/// Where a run of class a ends and one of b begins, P[row][a] - P[row][b] is added; the last run
/// ends at the bottom. @return the next group's runs
template <int kVectors>
HWY_INLINE const Run* add_group(const Strides& strides,
                                const std::int16_t* HWY_RESTRICT entries,
                                const Run* HWY_RESTRICT run,
                                std::int16_t* HWY_RESTRICT low,
                                std::int16_t* HWY_RESTRICT high) {
  Lanes lows[kVectors];
  Lanes highs[kVectors];
  for (int i = 0; i < kVectors; ++i) {
    lows[i] = hn::LoadU(kTag, low + i * kLanes);
    highs[i] = hn::LoadU(kTag, high + i * kLanes);
  }
  for (int residue = 0; residue < strides.residues; ++residue) {
    Lanes column[kVectors];
    for (int i = 0; i < kVectors; ++i) column[i] = hn::Zero(kTag);
    for (; run->end_row != strides.rows; ++run) {
      const std::int16_t* const row = entries + run->end_row * strides.row;
      const std::int16_t* const ends = row + run[0].label * strides.label;
      const std::int16_t* const begins = row + run[1].label * strides.label;
      for (int i = 0; i < kVectors; ++i) {
        column[i] = hn::Add(
            column[i],
            hn::Sub(hn::Load(kTag, ends + i * kLanes), hn::Load(kTag, begins + i * kLanes)));
      }
    }
    const std::int16_t* const bottom =
        entries + run->end_row * strides.row + run->label * strides.label;
    for (int i = 0; i < kVectors; ++i) {
      column[i] = hn::Add(column[i], hn::Load(kTag, bottom + i * kLanes));
      lows[i] = hn::Add(lows[i], column[i]);
      highs[i] = hn::Add(highs[i], hn::ShiftRight<8>(column[i]));
    }
    ++run;
    entries += strides.residue;
  }
  for (int i = 0; i < kVectors; ++i) {
    hn::StoreU(lows[i], kTag, low + i * kLanes);
    hn::StoreU(highs[i], kTag, high + i * kLanes);
  }
  return run;
}

/// The groups [begin, end) of the view and those half a turn further, against the observed groups
/// [lane, lane + kVectors · kLanes).
template <int kVectors>
HWY_ATTR void add_lanes(const PrefixTable& table,
                        const ColumnView& view,
                        int lane,
                        int begin,
                        int end,
                        UnfoldedSums* halves) {
  const Strides strides(table);
  const std::int16_t* const entries = table.entries() + lane;
  const auto runs_of = [&view, &strides](int group) {
    return view.column(group * strides.residues).data();
  };
  const Run* near = runs_of(begin);
  const Run* far = runs_of(begin + kHalf);
  for (int q = begin; q < end; ++q) {
    const int at = lane - q + kHeadings;
    near = add_group<kVectors>(strides, entries, near, halves[0].low + at, halves[0].high + at);
    far = add_group<kVectors>(strides, entries, far, halves[1].low + at, halves[1].high + at);
  }
}

HWY_ATTR void sweep(const PrefixTable& table, const ColumnView& view, std::int32_t* sums) {
  const int width = static_cast<int>(table.width());
  const int step = std::clamp(kMostColumns / table.residues(), 1, kHalf);
  std::int32_t unfolded[2][kUnfolded] = {};
  for (int q = 0; q < kHalf; q += step) {
    UnfoldedSums halves[2];
    const int end = std::min(q + step, kHalf);
    // Four vectors at a time leave registers for what is summed over rows.
    int lane = 0;
    for (; width - lane >= 4 * kLanes; lane += 4 * kLanes) {
      add_lanes<4>(table, view, lane, q, end, halves);
    }
    for (; width - lane >= 2 * kLanes; lane += 2 * kLanes) {
      add_lanes<2>(table, view, lane, q, end, halves);
    }
    for (; lane < width; lane += kLanes) add_lanes<1>(table, view, lane, q, end, halves);
    halves[0].add_to(unfolded[0]);
    halves[1].add_to(unfolded[1]);
  }
  for (int k = 0; k < kHeadings; ++k) {
    const int turned = (k + kHeadings - table.first_group()) % kHeadings;
    const int opposite = (turned + kHalf) % kHeadings;
    sums[k] = unfolded[0][turned] + unfolded[0][turned + kHeadings] + unfolded[1][opposite] +
              unfolded[1][opposite + kHeadings];
  }
}

}  // namespace semview::similarity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace semview::similarity {

HWY_EXPORT(sweep);

void sweep_runs(const PrefixTable& table,
                const ColumnView& view,
                std::span<std::int32_t, PoseGrid::kHeadings> sums) {
  HWY_DYNAMIC_DISPATCH(sweep)(table, view, sums.data());
}

std::int32_t sum_runs(const PrefixTable& table, const ColumnView& view, int heading) {
  const std::size_t row_stride = table.row_stride();
  const std::size_t class_stride = table.class_stride();
  const int rows = table.rows();
  std::int32_t total = 0;
  for (int g = 0; g < table.groups(); ++g) {
    const int turned = table.first_group() + g - heading;
    const int q = turned < 0 ? turned + PoseGrid::kHeadings : turned;
    const Run* run = view.column(q * table.residues()).data();
    const std::int16_t* column = table.entries() + g;
    for (int residue = 0; residue < table.residues(); ++residue) {
      for (; run->end_row != rows; ++run) {
        const std::int16_t* const row = column + run->end_row * row_stride;
        total += row[run[0].label * class_stride] - row[run[1].label * class_stride];
      }
      total += column[run->end_row * row_stride + run->label * class_stride];
      ++run;
      column += table.width();
    }
  }
  return total;
}

}  // namespace semview::similarity
#endif  // HWY_ONCE
