// SPDX-License-Identifier: Apache-2.0
/// What is likely in a view, column after column; for the sources of this module.
///
/// A view is walked from left to right. Where the classes of a column are not those of the column
/// before, it is *fresh* and told run by run. Between fresh columns only the edges between runs
/// move, and each edge tells, whenever it has moved, in how many columns it will move next: edges
/// move as steadily as the corners of a room do. So columns in which nothing moves cost nothing.
/// The walk is one template for writing and reading (`SymbolWriter`, `SymbolReader`).
/// docs/formats/cache_record.md#codec-2 lists the symbols; changing anything here is a new codec.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "semview/view/column_view.hpp"
#include "semview/view/known_labels.hpp"
#include "semview/view/view_situations.hpp"
#include "semview/view/view_symbols.hpp"

namespace semview::detail {

/// The lower border of a run, and how it has moved from column to column.
struct Edge {
  std::int32_t row = 0;     ///< the run's end
  ClassId label = kNoHit;   ///< of the run above it
  bool taken = false;       ///< an edge of the next column goes on from it
  std::int32_t step = 0;    ///< its last move, rows; 0: it has not moved yet
  std::int32_t moved = 0;   ///< the column in which it moved last, or came up
  std::int32_t period = 0;  ///< columns between its last two moves; 0: it has not moved
  std::int32_t before = 0;  ///< the period before that one
  std::int32_t told = 0;    ///< the column in which its next move was told
  std::uint32_t next = 0;   ///< writing: the symbol that tells it; reading: the column of that move
};

/// Codes the columns of one view from left to right. `Coder` is SymbolWriter or SymbolReader.
template <typename Coder>
class ColumnWalk {
 public:
  ColumnWalk(Coder& coder, int columns, int rows, bool ranges)
      : coder_(coder), columns_(columns), rows_(rows), ranges_(ranges) {
    constexpr std::size_t kUsual = 16;
    edges_.reserve(kUsual);
    next_edges_.reserve(kUsual);
    edges_.push_back({rows});
  }

  /// Writes a fresh column, `gap` before the next one or the end, or reads it, which is `edges()`
  /// then. The first column is fresh.
  /// @returns false if what was read is no column.
  bool code_fresh(int column, std::span<const Run> runs, int gap) {
    column_ = column;
    gap = code_gap(ViewSituations::kFreshGap, gap);
    if (Coder::kDecodes && (gap == 0 || gap > columns_ - column)) return false;
    next_fresh_ = column + gap;
    if (!code_runs(runs)) return false;
    next_move_ = kNever;
    for (std::size_t i = 0; i + 1 < edges_.size(); ++i) {
      if (edges_[i].told == kNotYet) tell_next_move(edges_[i]);
      next_move_ = std::min(next_move_, edges_[i].next);
    }
    return true;
  }

  /// Writes a column of the same classes as that to its left, at least one edge elsewhere: `moved`
  /// has a bit for each edge, the last one for all from the 64th on.
  void write_moves(int column, std::span<const Run> runs, std::uint64_t moved) {
    column_ = column;
    constexpr std::uint64_t kMany = std::uint64_t{1} << 63U;
    for (std::uint64_t left = moved & ~kMany; left != 0; left &= left - 1) {
      write_move(static_cast<std::size_t>(std::countr_zero(left)), runs);
    }
    if ((moved & kMany) == 0) return;
    for (std::size_t i = 63; i < runs.size(); ++i) {
      if (runs[i].end_row != edges_[i].row) write_move(i, runs);
    }
  }

  /// Reads such a column, which is `edges()` then. @returns false if what was read is none.
  bool read_moves(int column) {
    column_ = column;
    next_move_ = kNever;
    std::int32_t above = 0;
    for (std::size_t i = 0; i + 1 < edges_.size(); ++i) {
      Edge& edge = edges_[i];
      if (edge.next == static_cast<std::uint32_t>(column)) code_move(edge, 0);
      if (edge.row <= above || edge.row >= rows_) return false;
      above = edge.row;
      next_move_ = std::min(next_move_, edge.next);
    }
    return true;
  }

  std::span<const Edge> edges() const { return edges_; }
  int next_fresh() const { return next_fresh_; }
  /// Reading: no edge moves before this column, if no fresh one comes.
  std::uint32_t next_move() const { return next_move_; }

 private:
  static constexpr std::uint32_t kNever = ~0U;
  static constexpr std::int32_t kNotYet = -1;

  std::int32_t code_gap(Situation situation, std::int32_t gap) {
    const GapCode wanted = GapCode::of(static_cast<std::uint32_t>(gap));
    const std::uint32_t symbol = coder_.code(situation, wanted.symbol);
    const unsigned bits = GapCode::bits_of(symbol);
    const std::uint32_t plain = bits == 0 ? 0 : coder_.plain(wanted.plain, bits);
    return static_cast<std::int32_t>(GapCode::first_of(symbol) + plain);
  }

  void tell_next_move(Edge& edge) {
    const std::int32_t to_fresh = next_fresh_ - column_;
    const Situation situation = ViewSituations::gap(edge.period, edge.before, to_fresh);
    edge.told = column_;
    if constexpr (Coder::kDecodes) {
      const std::int32_t gap = code_gap(situation, 0);
      edge.next = gap == 0 ? kNever : static_cast<std::uint32_t>(column_ + gap);
    } else {
      edge.next = coder_.open_gap(situation);
    }
  }

  void write_move(std::size_t i, std::span<const Run> runs) {
    Edge& edge = edges_[i];
    coder_.close_gap(edge.next, static_cast<std::uint32_t>(column_ - edge.told));
    code_move(edge, runs[i].end_row - edge.row);
  }

  void code_move(Edge& edge, std::int32_t step) {
    step = code_step(edge, step);
    note_move(edge, step);
    tell_next_move(edge);
  }

  /// Steps are told by how they go on from the last one, so that up and down are alike.
  std::int32_t code_step(const Edge& edge, std::int32_t step) {
    const Situation situation = ViewSituations::step(edge.step, column_ - edge.told, edge.period);
    const std::int32_t sign = edge.step < 0 ? -1 : 1;
    const std::int32_t wanted = sign * step;
    const bool near = wanted >= -kStepsBack && wanted <= kStepsAhead;
    const std::int32_t place = wanted + kStepsBack - (wanted > 0 ? 1 : 0);
    const std::uint32_t symbol =
        coder_.code(situation, near ? static_cast<std::uint32_t>(place) : kStepElsewhere);
    if (symbol == kStepElsewhere) {
      const auto plain = static_cast<std::uint32_t>(step + kMostRows);
      return static_cast<std::int32_t>(coder_.plain(plain, kStepBits)) - kMostRows;
    }
    const std::int32_t behind = static_cast<std::int32_t>(symbol) - kStepsBack;
    return sign * (behind >= 0 ? behind + 1 : behind);
  }

  void note_move(Edge& edge, std::int32_t step) const {
    edge.row += step;
    edge.before = edge.period;
    edge.period = column_ - edge.moved;
    edge.moved = column_;
    edge.step = step;
  }

  /// Run by run from the top.
  bool code_runs(std::span<const Run> runs) {
    next_edges_.clear();
    for (Edge& edge : edges_) edge.taken = false;
    std::int32_t row = 0;
    std::size_t left = 0;  // the run to the left of `row`
    bool went_on = false;
    for (std::size_t k = 0; row < rows_; ++k) {
      while (edges_[left].row <= row) ++left;
      Edge edge;
      std::int32_t end = 0;
      if constexpr (!Coder::kDecodes) {
        edge.label = runs[k].label;
        end = runs[k].end_row;
      }
      code_label(edge.label, left, row, went_on);
      went_on = edge.label == edges_[left].label;
      if (!code_end(edge, end, left, row)) return false;
      row = edge.row;
      next_edges_.push_back(edge);
    }
    std::swap(edges_, next_edges_);
    return true;
  }

  void code_label(ClassId& label, std::size_t left, std::int32_t row, bool went_on) {
    const bool top = next_edges_.empty();
    const std::uint32_t above = top ? kTopOfColumn : next_edges_.back().label;
    // Without planes, neighbouring runs differ in class.
    labels_.ask(ranges_ ? kTopOfColumn : above);
    const bool left_possible = labels_.suggest(edges_[left].label);
    labels_.suggest_follower_of(above);
    if (left + 1 < edges_.size()) labels_.suggest(edges_[left + 1].label);
    const bool at_edge = left > 0 && edges_[left - 1].row == row;
    const std::uint32_t place = top ? 0 : 1 + (at_edge ? 1U : 0U) + (went_on ? 2U : 0U);
    const Situation situation = ViewSituations::label(labels_.suggested(), left_possible, place);
    label = labels_.code(coder_, situation, label);
    labels_.note(above, label);
  }

  bool code_end(Edge& edge, std::int32_t end, std::size_t left, std::int32_t row) {
    const std::size_t stop = std::min(edges_.size(), left + kEndCandidates);
    const Situation situation =
        ViewSituations::end(static_cast<std::uint32_t>(stop - left),
                            stop == edges_.size(),
                            edges_[left].label == edge.label,
                            left + 1 < stop && edges_[left + 1].label == edge.label);
    std::uint32_t symbol = Coder::kDecodes ? 0 : end_symbol(end, left, stop);
    symbol = coder_.code(situation, symbol);
    edge.moved = column_;
    edge.told = kNotYet;
    if (symbol == kEndElsewhere) {
      edge.row = row + code_height(end - row);
      return edge.row <= rows_;
    }
    constexpr std::uint32_t kSteps = 2 * kReach + 1;
    const std::size_t candidate = left + symbol / kSteps;
    const std::int32_t step = static_cast<std::int32_t>(symbol % kSteps) - kReach;
    if (candidate >= stop) return false;
    follow(edge, edges_[candidate], step);
    return edge.row > row && edge.row <= rows_;
  }

  std::uint32_t end_symbol(std::int32_t end, std::size_t left, std::size_t stop) const {
    for (std::size_t i = left; i < stop; ++i) {
      const std::int32_t step = end - edges_[i].row;
      const bool border = edges_[i].row == rows_ || end == rows_;
      if (border ? step == 0 : std::abs(step) <= kReach) {
        return static_cast<std::uint32_t>(i - left) * (2 * kReach + 1) +
               static_cast<std::uint32_t>(step + kReach);
      }
    }
    return kEndElsewhere;
  }

  /// Takes over the history of an edge to the left, if no other has.
  void follow(Edge& edge, Edge& from, std::int32_t step) const {
    edge.row = from.row + step;
    if (from.taken) return;
    from.taken = true;
    const ClassId label = edge.label;
    edge = from;
    edge.label = label;
    if (step == 0) return;
    note_move(edge, step);
    edge.told = kNotYet;
  }

  /// Of a run, 1 or more rows.
  std::int32_t code_height(std::int32_t height) {
    const auto wanted = static_cast<std::uint32_t>(height - 1);
    const std::uint32_t symbol =
        coder_.code(ViewSituations::kRow, std::min(wanted >> kRowBits, kRowSymbols - 1));
    const std::uint32_t first = symbol << kRowBits;
    const unsigned bits = symbol == kRowSymbols - 1 ? kStepBits : kRowBits;
    return static_cast<std::int32_t>(first + coder_.plain(wanted - first, bits)) + 1;
  }

  static constexpr std::int32_t kMostRows = 1024;
  static constexpr unsigned kStepBits = 11;
  static constexpr unsigned kRowBits = 3;

  Coder& coder_;
  std::int32_t columns_;
  std::int32_t rows_;
  bool ranges_;
  std::int32_t column_ = 0;
  std::int32_t next_fresh_ = 0;
  std::uint32_t next_move_ = kNever;
  std::vector<Edge> edges_;  // of the column coded last
  std::vector<Edge> next_edges_;
  KnownLabels labels_;
};

}  // namespace semview::detail
