// SPDX-License-Identifier: Apache-2.0
/// What planes are likely in a view with ranges; for the sources of this module.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "semview/view/column_view.hpp"
#include "semview/view/range_coder.hpp"

namespace semview::detail {

/// Codes planes by their difference to what the columns to the left foretell, without loss.
///
/// Along a flat surface, a = n·cos(azimuth - of its normal) and b does not change. So
/// a(c + 1) = 2·cos(step)·a(c) - a(c - 1), to the last bits of a float.
class PlaneModel {
 public:
  explicit PlaneModel(int columns)
      : twice_cosine_(static_cast<float>(2.0 * std::cos(2.0 * std::numbers::pi / columns))) {}

  /// Writes the planes of a view, one a run, or reads them into `planes`.
  template <typename Coder>
  void code(Coder& coder,
            std::span<const std::uint32_t> first_run,
            std::span<const Run> runs,
            std::span<RunPlane> planes) {
    std::vector<State> left;
    std::vector<State> states;
    for (std::size_t c = 0; c + 1 < first_run.size(); ++c) {
      const auto column = runs.subspan(first_run[c], first_run[c + 1] - first_run[c]);
      states.assign(column.size(), {});
      if (c > 0) {
        go_on(
            runs.subspan(first_run[c - 1], first_run[c] - first_run[c - 1]), left, column, states);
      }
      for (std::size_t i = 0; i < column.size(); ++i) {
        RunPlane& plane = planes[first_run[c] + i];
        code_plane(coder, column[i].label, plane, states[i]);
        plane = states[i].plane;
      }
      std::swap(left, states);
    }
  }

 private:
  /// The plane of a run, and that of the run it goes on from in the column before.
  struct State {
    RunPlane plane;
    float a_before_per_m = 0.0F;
    int columns = 0;  ///< in a row that may lie on one surface; 2 stands for more
  };

  /// Each run goes on that to the left of its first row, if that is of its class; in a column of
  /// the same classes, on the one in its place.
  static void go_on(std::span<const Run> left,
                    std::span<const State> left_states,
                    std::span<const Run> column,
                    std::span<State> states) {
    const auto same_class = [](const Run& a, const Run& b) { return a.label == b.label; };
    if (std::equal(left.begin(), left.end(), column.begin(), column.end(), same_class)) {
      std::copy(left_states.begin(), left_states.end(), states.begin());
      return;
    }
    std::size_t at = 0;
    for (std::size_t i = 0; i < column.size(); ++i) {
      while (i > 0 && left[at].end_row <= column[i - 1].end_row) ++at;
      if (same_class(left[at], column[i])) states[i] = left_states[at];
    }
  }

  template <typename Coder>
  void code_plane(Coder& coder, ClassId label, const RunPlane& plane, State& state) {
    if (label == kNoHit) {
      state = {};
      return;
    }
    const bool known = state.columns > 0;
    const RunPlane foretold = known ? RunPlane{foretell(state), state.plane.b_per_m} : last_[label];
    const auto history = static_cast<std::size_t>(state.columns);
    RunPlane coded;
    coded.b_per_m =
        number(code_difference(coder, b_[history], order(foretold.b_per_m), order(plane.b_per_m)));
    const std::int32_t a_foretold = order(foretold.a_per_m);
    const std::int32_t a = code_difference(coder, a_[history], a_foretold, order(plane.a_per_m));
    coded.a_per_m = number(a);
    const bool jumps =
        coded.b_per_m != foretold.b_per_m ||
        (state.columns == 2 && std::abs(std::int64_t{a} - a_foretold) > kSameSurface);
    state.a_before_per_m = state.plane.a_per_m;
    state.columns = known && !jumps ? 2 : 1;
    state.plane = coded;
    last_[label] = coded;
  }

  static constexpr std::int64_t kSameSurface = 1 << 12;

  /// Bits of a difference: how many they are, one question a step, then all but the highest plain.
  struct Difference {
    std::array<AdaptiveBit, 33> longer;
    AdaptiveBit negative;
  };

  /// The product of two floats is exact in double, so that contracting it with the difference into
  /// one instruction, as some machines do, gives the same bits.
  float foretell(const State& state) const {
    if (state.columns < 2) return state.plane.a_per_m;
    const double a = static_cast<double>(twice_cosine_) * static_cast<double>(state.plane.a_per_m) -
                     static_cast<double>(state.a_before_per_m);
    constexpr double kLargest = std::numeric_limits<float>::max();
    return a > -kLargest && a < kLargest ? static_cast<float>(a) : state.plane.a_per_m;
  }

  /// Floats as integers in the same order, neighbours next to each other.
  static std::int32_t order(float value) {
    const auto bits = std::bit_cast<std::int32_t>(value);
    return bits < 0 ? std::numeric_limits<std::int32_t>::min() - bits : bits;
  }
  static float number(std::int32_t order) {
    return std::bit_cast<float>(order < 0 ? std::numeric_limits<std::int32_t>::min() - order
                                          : order);
  }

  template <typename Coder>
  static std::int32_t code_difference(Coder& coder,
                                      Difference& situations,
                                      std::int32_t from,
                                      std::int32_t to) {
    const auto difference = static_cast<std::int32_t>(static_cast<std::uint32_t>(to) -
                                                      static_cast<std::uint32_t>(from));
    const std::uint32_t wanted = difference < 0 ? 0U - static_cast<std::uint32_t>(difference)
                                                : static_cast<std::uint32_t>(difference);
    const auto wanted_bits = static_cast<unsigned>(std::bit_width(wanted));
    unsigned bits = 0;
    while (bits < 32 && coder.code(situations.longer[bits], wanted_bits > bits)) ++bits;
    if (bits == 0) return from;
    const bool negative = coder.code(situations.negative, difference < 0);
    const std::uint32_t highest = 1U << (bits - 1);
    const std::uint32_t size = highest | coder.code_plain(wanted & (highest - 1), bits - 1);
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(from) +
                                     (negative ? 0U - size : size));
  }

  float twice_cosine_;
  std::array<Difference, 3> a_;
  std::array<Difference, 3> b_;
  std::array<RunPlane, 256> last_{};  // of each class
};

}  // namespace semview::detail
