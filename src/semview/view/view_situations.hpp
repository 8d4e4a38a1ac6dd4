// SPDX-License-Identifier: Apache-2.0
/// The situations of `ColumnWalk` and how likely each symbol is in them; for the sources of this
/// module.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "semview/view/range_coder.hpp"

namespace semview::detail {

/// Names a row of the table of likelihoods.
using Situation = std::uint32_t;

// Symbols. 0 of a gap is that an edge ends before it moves again.
inline constexpr std::uint32_t kGapSymbols = 18;
inline constexpr std::uint32_t kStepSymbols = 12;
inline constexpr std::uint32_t kStepElsewhere = kStepSymbols - 1;
inline constexpr std::int32_t kStepsBack = 4;   // the first symbols of a step: against the last one
inline constexpr std::int32_t kStepsAhead = 7;  // and those that follow: with it
inline constexpr std::uint32_t kLabelCandidates = 3;
inline constexpr std::uint32_t kLabelKnown = kLabelCandidates;
inline constexpr std::uint32_t kLabelElsewhere = kLabelCandidates + 1;
inline constexpr std::uint32_t kKnownLabels = 12;
inline constexpr std::uint32_t kEndCandidates = 3;
inline constexpr std::int32_t kReach = 2;  // rows within which an edge counts as that of the left
inline constexpr std::uint32_t kEndElsewhere = kEndCandidates * (2 * kReach + 1);
inline constexpr std::uint32_t kRowSymbols = 16;
inline constexpr std::uint32_t kMostSymbols = kGapSymbols;

/// Each function names one situation; its arguments are what the walk knows there.
class ViewSituations {
 public:
  /// The columns to the next fresh one.
  static constexpr Situation kFreshGap = 0;
  /// The rows from a run's first to its last where no edge to the left tells it.
  static constexpr Situation kRow = 1;
  static constexpr Situation kKnown = 2;
  static constexpr Situation kEnd = kKnown + 9;
  static constexpr Situation kLabel = kEnd + 24;
  static constexpr Situation kStep = kLabel + 40;
  static constexpr Situation kFirstGap = kStep + 30;
  static constexpr Situation kGap = kFirstGap + 7;
  static constexpr Situation kCount = kGap + 8 * 9 * 3;

  /// Which of `count` known labels it is.
  static Situation known(std::uint32_t count) { return kKnown + std::min(count, 8U); }
  /// `candidates` edges to the left, the last of them the lower border of the view or not.
  static Situation end(std::uint32_t candidates, bool last, bool goes_on, bool second_is_it) {
    return kEnd + (candidates - 1) * 8 + (last ? 4U : 0U) + (goes_on ? 2U : 0U) +
           (second_is_it ? 1U : 0U);
  }
  /// `left_possible`: the class to the left is not that of the run above. `place` is 0 at the top.
  static Situation label(std::uint32_t candidates, bool left_possible, std::uint32_t place) {
    return kLabel + candidates + 4 * ((left_possible ? 1U : 0U) + 2 * place);
  }
  /// `gap` columns after its next move was told; `period` lay between the two moves before.
  static Situation step(std::int32_t last_step, std::int32_t gap, std::int32_t period) {
    const auto size = static_cast<Situation>(std::min(std::abs(last_step), 4));
    const auto wait = static_cast<Situation>(std::min(gap, 3) - 1);
    return kStep + (size * 3 + wait) * 2 + (period > 1 ? 1 : 0);
  }
  /// `period` and `before` lay between its last moves, 0 if it has not moved so often; the next
  /// fresh column is `to_fresh` away.
  static Situation gap(std::int32_t period, std::int32_t before, std::int32_t to_fresh) {
    const int room = (to_fresh > period ? 1 : 0) + (to_fresh > 2 * period + 1 ? 1 : 0);
    const int first = std::min<int>(std::bit_width(static_cast<unsigned>(to_fresh)), 6);
    const Situation last =
        kGap + ((roughly(period) - 1) * 9 + roughly(before)) * 3 + static_cast<Situation>(room);
    return period == 0 ? kFirstGap + static_cast<Situation>(first) : last;
  }

 private:
  /// Of a number of columns, one of nine.
  static Situation roughly(std::int32_t columns) {
    constexpr std::array<std::uint8_t, 18> kRough = {
        0, 1, 2, 3, 4, 5, 5, 6, 6, 6, 7, 7, 7, 7, 7, 7, 7, 8};
    return kRough[static_cast<std::size_t>(std::min(columns, 17))];
  }
};

/// How many symbols a situation knows.
constexpr std::uint32_t symbols_of(Situation situation) {
  if (situation == ViewSituations::kFreshGap || situation >= ViewSituations::kFirstGap) {
    return kGapSymbols;
  }
  if (situation == ViewSituations::kRow) return kRowSymbols;
  if (situation < ViewSituations::kEnd) return kKnownLabels;
  if (situation < ViewSituations::kLabel) return kEndElsewhere + 1;
  if (situation < ViewSituations::kStep) return kLabelElsewhere + 1;
  return kStepSymbols;
}

/// The share of each symbol in each situation.
struct ShareTable {
  /// Where each symbol's share starts, and where the last one ends.
  std::array<std::array<std::uint16_t, kMostSymbols + 1>, ViewSituations::kCount> starts{};

  constexpr Share share(Situation situation, std::uint32_t symbol) const {
    const auto& row = starts[situation];
    return {row[symbol], static_cast<std::uint32_t>(row[symbol + 1] - row[symbol])};
  }
  /// The symbol in whose share `place`, below 2^kShareBits, lies.
  constexpr std::uint32_t symbol_at(Situation situation, std::uint32_t place) const {
    const auto& row = starts[situation];
    std::uint32_t symbol = 0;
    while (row[symbol + 1] <= place) ++symbol;
    return symbol;
  }
};

/// What views of buildings have shown, view_situations.cpp.
extern const ShareTable kViewShares;

}  // namespace semview::detail
