// SPDX-License-Identifier: Apache-2.0
/// The rows of one panorama column while they are given away. Internal to this module.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "semview/view/column_view.hpp"

namespace semview::raycast {

/// The runs of column after column, as `ColumnView` takes them. Keeps its memory.
struct RunCollection {
  std::vector<std::uint32_t> first_run;
  std::vector<Run> runs;  // longer than needed: the last of `first_run` counts
  std::vector<RunPlane> planes;
};

/// What each row of a column shows: who comes first has it. Rows are bits of `kWords` words, so
/// that an interval is taken by a few operations without a branch.
template <std::size_t kWords, bool kRanges>
class RowMosaic {
 public:
  static constexpr std::size_t kMostRows = kWords * 64;

  explicit RowMosaic(int rows) : rows_(static_cast<std::size_t>(rows)), above_(rows_ + 1) {
    for (std::size_t row = 0; row <= rows_; ++row) {
      for (std::size_t w = 0; w < kWords; ++w) {
        const std::size_t before = w * 64;
        above_[row][w] = row >= before + 64 ? ~std::uint64_t{0}
                         : row > before     ? (std::uint64_t{1} << (row - before)) - 1
                                            : 0;
      }
    }
  }

  void clear() {
    free_ = above_[rows_];
    starts_ = {};
  }

  bool full() const {
    std::uint64_t any = 0;
    for (std::size_t w = 0; w < kWords; ++w) any |= free_[w];
    return any == 0;
  }

  /// Gives the rows [begin, end) that are still free to a surface; none if begin >= end.
  void take(int begin, int end, ClassId label, const RunPlane& plane) {
    const Words& before_end = above_[static_cast<std::size_t>(end)];
    const Words& before_begin = above_[static_cast<std::size_t>(begin)];
    Words starts;
    std::uint64_t carry = 0;
    std::uint64_t more = 0;
    for (std::size_t w = 0; w < kWords; ++w) {
      const std::uint64_t taken = free_[w] & before_end[w] & ~before_begin[w];
      free_[w] ^= taken;
      starts[w] = taken & ~(taken << 1 | carry);
      starts_[w] |= starts[w];
      carry = taken >> 63;
    }
    // Nearly always one piece or none, which is put where no row is.
    std::size_t first = kMostRows;
    for (std::size_t w = kWords; w-- > 0;) {
      if (starts[w] == 0) continue;
      more |= first != kMostRows ? 1 : starts[w] & (starts[w] - 1);
      first = w * 64 + static_cast<std::size_t>(std::countr_zero(starts[w]));
    }
    begin_surface(first, label, plane);
    if (more != 0) begin_surfaces(starts, label, plane);
  }

  /// Ends the column; rows that nobody took are `kNoHit`.
  void append_runs(RunCollection& out) {
    if (!full()) take(0, static_cast<int>(rows_), kNoHit, {});
    std::size_t n = out.first_run.back();
    reserve(out, n + rows_);
    Run* runs = out.runs.data();
    RunPlane* planes = out.planes.data();
    ClassId label = labels_[0];
    RunPlane plane = kRanges ? planes_[0] : RunPlane{};
    // Writes each run that may end here, and goes on behind it if it does.
    const auto end_at = [&](std::size_t row) {
      runs[n] = {static_cast<std::uint16_t>(row), label};
      if constexpr (kRanges) planes[n] = plane;
    };
    for (std::size_t w = 0; w < kWords; ++w) {
      for (std::uint64_t bits = starts_[w]; bits != 0; bits &= bits - 1) {
        const std::size_t row = w * 64 + static_cast<std::size_t>(std::countr_zero(bits));
        end_at(row);
        bool ends = labels_[row] != label;
        if constexpr (kRanges) ends |= !(planes_[row] == plane);
        n += ends ? 1 : 0;
        label = labels_[row];
        if constexpr (kRanges) plane = planes_[row];
      }
    }
    end_at(rows_);
    out.first_run.push_back(static_cast<std::uint32_t>(n + 1));
  }

 private:
  using Words = std::array<std::uint64_t, kWords>;

  void begin_surface(std::size_t row, ClassId label, const RunPlane& plane) {
    labels_[row] = label;
    if constexpr (kRanges) planes_[row] = plane;
  }
  void begin_surfaces(const Words& starts, ClassId label, const RunPlane& plane) {
    for (std::size_t w = 0; w < kWords; ++w) {
      for (std::uint64_t bits = starts[w]; bits != 0; bits &= bits - 1) {
        begin_surface(w * 64 + static_cast<std::size_t>(std::countr_zero(bits)), label, plane);
      }
    }
  }
  static void reserve(RunCollection& out, std::size_t least) {
    if (out.runs.size() < least) out.runs.resize(2 * least);
    if (kRanges && out.planes.size() < least) out.planes.resize(2 * least);
  }

  std::size_t rows_;
  std::vector<Words> above_;  // [row]: the bits of the rows above it
  Words free_{};
  Words starts_{};  // where a surface begins
  std::array<ClassId, kMostRows + 1> labels_;
  std::array<RunPlane, kRanges ? kMostRows + 1 : 1> planes_;
};

}  // namespace semview::raycast
