// SPDX-License-Identifier: Apache-2.0
/// The rows of one panorama column while they are given away. Internal to this module.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "semview/raycast/row_finder.hpp"
#include "semview/view/column_view.hpp"

namespace semview::raycast {

/// The runs of column after column, as `ColumnView` takes them. Keeps its memory.
struct RunCollection {
  std::vector<std::uint32_t> first_run;
  std::vector<Run> runs;  // longer than needed: the last of `first_run` counts
  std::vector<RunPlane> planes;
};

/// A label and a plane, each in a word: passed in registers, and stored as they are loaded again.
struct Surface {
  std::uint64_t plane = 0;  // bits of a RunPlane
  std::uint64_t label = kNoHit;

  Surface() = default;
  Surface(ClassId label_id, const RunPlane& run_plane)
      : plane(std::bit_cast<std::uint64_t>(run_plane)), label(label_id) {}
  static Surface upright(std::uint64_t label, float near_per_m) {
    static_assert(std::endian::native == std::endian::little && sizeof(RunPlane) == 8);
    Surface surface;
    surface.plane = std::bit_cast<std::uint32_t>(near_per_m);
    surface.label = label;
    return surface;
  }
};

/// Appends runs of one column from top to bottom. There must be room.
template <bool kRanges>
class RunWriter {
 public:
  RunWriter(RunCollection& out, std::uint32_t runs)
      : runs_(out.runs.data()), planes_(out.planes.data()), next_(runs) {}

  /// From where the last ended to above a row; nothing if there is none.
  void add(int end_row, Surface surface) {
    if (end_row <= end_row_) return;
    const bool goes_on =
        end_row_ != 0 && surface.label == last_.label && (!kRanges || surface.plane == last_.plane);
    next_ += goes_on ? 0 : 1;
    runs_[next_ - 1] = {static_cast<std::uint16_t>(end_row), static_cast<ClassId>(surface.label)};
    if constexpr (kRanges) planes_[next_ - 1] = std::bit_cast<RunPlane>(surface.plane);
    end_row_ = end_row;
    last_ = surface;
  }

  /// Of all columns so far.
  std::uint32_t runs() const { return next_; }

 private:
  Run* runs_;
  RunPlane* planes_;
  std::uint32_t next_;
  int end_row_ = 0;
  Surface last_;
};

/// What each row of a column shows: who comes first has it. Rows are bits of `kWords` words, or
/// more than the camera has, so that an interval is taken by a few operations without a branch.
template <std::size_t kWords, bool kRanges>
class RowMosaic {
 public:
  static constexpr bool kHasPlanes = kRanges;

  explicit RowMosaic(const RowTable& table) : rows_(table.rows), bits_above_(table.bits_above) {}

  void clear() {
    const std::uint64_t* all = bits_above(rows_);
    for (std::size_t w = 0; w < kWords; ++w) {
      free_[w] = all[w];
      starts_[w] = 0;
    }
  }

  bool full() const {
    std::uint64_t any = 0;
    for (std::size_t w = 0; w < kWords; ++w) any |= free_[w];
    return any == 0;
  }

  /// Gives the rows [begin, end) that are still free to a surface; none if begin >= end.
  void take(int begin, int end, Surface surface) {
    const std::uint64_t* above_end = bits_above(end);
    const std::uint64_t* above_begin = bits_above(begin);
    std::array<std::uint64_t, kWords> starts;
    std::uint64_t carry = 0;
    for (std::size_t w = 0; w < kWords; ++w) {
      const std::uint64_t taken = free_[w] & above_end[w] & ~above_begin[w];
      free_[w] ^= taken;
      starts[w] = taken & ~(taken << 1 | carry);
      starts_[w] |= starts[w];
      carry = taken >> 63;
    }
    // Nearly always one piece or none, which is put where no row is.
    std::size_t first = kWords * 64;
    std::uint64_t more = 0;
    for (std::size_t w = kWords; w-- > 0;) {
      more = starts[w] != 0 && first != kWords * 64 ? 1 : more | (starts[w] & (starts[w] - 1));
      first = starts[w] != 0 ? w * 64 + lowest_bit(starts[w]) : first;
    }
    begin_surface(first, surface);
    if (more != 0) begin_surfaces(starts, surface);
  }

  /// Ends the column; rows that nobody took are `kNoHit`. Room for all rows must be there.
  std::uint32_t append_runs(RunCollection& out, std::uint32_t n) {
    if (!full()) take(0, rows_, {});
    Run* runs = out.runs.data();
    RunPlane* planes = out.planes.data();
    Surface last = surface_at(0);
    // Writes each run that may end here, and goes on behind it if it does.
    for (std::size_t w = 0; w < kWords; ++w) {
      for (std::uint64_t bits = starts_[w]; bits != 0; bits &= bits - 1) {
        const std::size_t row = w * 64 + lowest_bit(bits);
        const Surface next = surface_at(row);
        write(runs, planes, n, row, last);
        const bool ends = next.label != last.label || (kRanges && next.plane != last.plane);
        n += ends ? 1 : 0;
        last = next;
      }
    }
    write(runs, planes, n, static_cast<std::size_t>(rows_), last);
    return n + 1;
  }

 private:
  const std::uint64_t* bits_above(int row) const {
    return bits_above_ + static_cast<std::size_t>(row) * kWords;
  }
  static std::size_t lowest_bit(std::uint64_t bits) {
    return static_cast<std::size_t>(std::countr_zero(bits));
  }
  static void write(
      Run* runs, RunPlane* planes, std::uint32_t n, std::size_t end, Surface surface) {
    runs[n] = {static_cast<std::uint16_t>(end), static_cast<ClassId>(surface.label)};
    if constexpr (kRanges) planes[n] = std::bit_cast<RunPlane>(surface.plane);
  }
  void begin_surface(std::size_t row, Surface surface) {
    labels_[row] = surface.label;
    if constexpr (kRanges) planes_[row] = surface.plane;
  }
  Surface surface_at(std::size_t row) const {
    Surface surface;
    surface.label = labels_[row];
    if constexpr (kRanges) surface.plane = planes_[row];
    return surface;
  }
  void begin_surfaces(const std::array<std::uint64_t, kWords>& starts, Surface surface) {
    for (std::size_t w = 0; w < kWords; ++w) {
      for (std::uint64_t bits = starts[w]; bits != 0; bits &= bits - 1) {
        begin_surface(w * 64 + lowest_bit(bits), surface);
      }
    }
  }

  int rows_;
  const std::uint64_t* bits_above_;
  std::array<std::uint64_t, kWords> free_{};
  std::array<std::uint64_t, kWords> starts_{};         // where a surface begins
  std::array<std::uint64_t, kWords * 64 + 1> labels_;  // where one begins
  std::array<std::uint64_t, kWords * 64 + 1> planes_;
};

}  // namespace semview::raycast
