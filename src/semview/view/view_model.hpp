// SPDX-License-Identifier: Apache-2.0
/// What is likely in a view, column after column; for the sources of this module.
///
/// A view is walked column by column. What a column can be is asked as yes-or-no questions, each in
/// a *situation* that says how likely yes is: edges between runs move as steadily as the corners of
/// a room do, so an edge that moved every fifth column will move again in the fifth. The walk is
/// one template for writing and reading (`RangeEncoder`, `RangeDecoder`).
/// docs/formats/cache_record.md#codec-2 lists the questions; changing anything here is a new codec.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "semview/view/column_view.hpp"
#include "semview/view/plane_model.hpp"
#include "semview/view/range_coder.hpp"
#include "semview/view/view_situations.hpp"

namespace semview::detail {

/// The lower border of a run, and how it has moved from column to column.
struct Edge {
  std::int32_t row = 0;     ///< the run's end
  std::int32_t moved = 0;   ///< the column in which it moved last, or came up
  std::int32_t period = 0;  ///< columns between its last two moves; 0: it has moved only once
  std::int32_t step = 0;    ///< its last move, rows
  ClassId label = kNoHit;   ///< of the run above it
};

/// Codes the columns of one view from left to right. `Coder` is RangeEncoder or RangeDecoder.
template <typename Coder>
class ColumnWalk {
 public:
  ColumnWalk(Coder& coder, int columns, int rows, bool ranges)
      : coder_(coder), rows_(rows), ranges_(ranges), planes_(columns) {
    while ((1 << row_bits_) <= rows) ++row_bits_;
    edges_.reserve(static_cast<std::size_t>(rows) + 1);
    next_.reserve(static_cast<std::size_t>(rows) + 1);
    edges_.push_back({rows, kNever, 0, 0, kNoHit});
    if (ranges) plane_states_.resize(1);
  }

  /// Writes `runs` (and, with ranges, `planes`), or reads a column, which is `edges()` then.
  /// @returns false if what was read is no column.
  bool code_column(std::span<const Run> runs, std::span<const RunPlane> planes) {
    const Change change = code_change(runs);
    if (change == Change::kMoved && !code_moves(runs)) return false;
    if (change == Change::kFresh && !code_fresh(runs)) return false;
    if (ranges_) code_planes(planes, change == Change::kFresh);
    if (change == Change::kFresh) {
      steady_columns_ = 0;
    } else {
      ++steady_columns_;
    }
    ++column_;
    return true;
  }

  std::span<const Edge> edges() const { return edges_; }
  /// The planes of the column coded last, one a run.
  std::span<const PlaneState> planes() const { return plane_states_; }
  const ViewSituations& situations() const { return situations_; }

 private:
  enum class Change { kNone, kMoved, kFresh };
  static constexpr std::int32_t kNever = -99;
  static constexpr std::int32_t kReach = 2;  // rows within which an edge counts as that of the left
  static constexpr std::size_t kCandidates = 3;
  static constexpr std::size_t kNoMatch = ~std::size_t{0};

  /// What the column is, against the one to its left.
  Change code_change(std::span<const Run> runs) {
    Change change = Change::kNone;
    if constexpr (!Coder::kDecodes) change = change_to(runs);
    const bool just_fresh = steady_columns_ == 0;
    if (coder_.code(situations_.unchanged(due_in(first_due_), due_in(second_due_), just_fresh),
                    change == Change::kNone)) {
      return Change::kNone;
    }
    // One run has no edge that could move.
    if (edges_.size() == 1) return Change::kFresh;
    return coder_.code(situations_.fresh(steady_columns_), change == Change::kFresh)
               ? Change::kFresh
               : Change::kMoved;
  }

  Change change_to(std::span<const Run> runs) const {
    if (runs.size() != edges_.size()) return Change::kFresh;
    bool moved = false;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (runs[i].label != edges_[i].label) return Change::kFresh;
      moved = moved || runs[i].end_row != edges_[i].row;
    }
    return moved ? Change::kMoved : Change::kNone;
  }

  /// The same classes as to the left, at least one edge elsewhere.
  bool code_moves(std::span<const Run> runs) {
    int moved = 0;  // 0: no edge yet, 1: by one row, 2: by more
    std::int32_t above = 0;
    for (std::size_t i = 0; i + 1 < edges_.size(); ++i) {
      Edge& edge = edges_[i];
      std::int32_t step = 0;
      if constexpr (!Coder::kDecodes) step = runs[i].end_row - edge.row;
      const std::int32_t age = column_ - edge.moved;
      const bool must = moved == 0 && i + 2 == edges_.size();
      if (must || coder_.code(situations_.moves(edge.period, age, edge.step, moved), step != 0)) {
        step = code_step(edge, age, step);
        move(edge, step);
        moved = std::abs(step) > 1 ? 2 : 1;
      }
      if (Coder::kDecodes && (edge.row <= above || edge.row >= rows_)) return false;
      above = edge.row;
    }
    find_next_due();
    return true;
  }

  std::int32_t code_step(const Edge& edge, std::int32_t age, std::int32_t step) {
    const bool down = coder_.code(situations_.down(edge.step, age), step > 0);
    const std::int32_t last_size = age == 1 ? std::abs(edge.step) : 0;
    const std::int32_t size = 1 + code_size(situations_.size(last_size), std::abs(step) - 1);
    return down ? size : -size;
  }

  /// Small numbers in unary, the others plain.
  std::int32_t code_size(std::span<AdaptiveBit, kSizeBits> more, std::int32_t size) {
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(kSizeBits); ++i) {
      if (!coder_.code(more[static_cast<std::size_t>(i)], size > i)) return i;
    }
    const auto unary = static_cast<std::uint32_t>(kSizeBits);
    const std::uint32_t rest = coder_.code_plain(static_cast<std::uint32_t>(size) - unary, 10);
    return static_cast<std::int32_t>(rest + unary);
  }

  void move(Edge& edge, std::int32_t step) const {
    edge.row += step;
    edge.period = column_ - edge.moved;
    edge.moved = column_;
    edge.step = step;
  }

  /// A column of other classes than that to its left, run by run from the top.
  bool code_fresh(std::span<const Run> runs) {
    next_.clear();
    matches_.clear();
    std::int32_t row = 0;
    std::size_t left = 0;  // the run to the left of `row`
    for (std::size_t k = 0; row < rows_; ++k) {
      while (edges_[left].row <= row) ++left;
      Edge edge{rows_, column_, 0, 0, kNoHit};
      std::int32_t end = 0;
      if constexpr (!Coder::kDecodes) {
        edge.label = runs[k].label;
        end = runs[k].end_row;
      }
      const bool goes_on = code_label(edge.label, left, row);
      if (!code_end(edge, end, left, row, goes_on)) return false;
      matches_.push_back(goes_on ? left : kNoMatch);
      row = edge.row;
      next_.push_back(edge);
    }
    std::swap(edges_, next_);
    find_next_due();
    return true;
  }

  /// @returns whether the class is that of the run to the left.
  bool code_label(ClassId& label, std::size_t left, std::int32_t row) {
    const ClassId left_label = edges_[left].label;
    const bool top = next_.empty();
    // Without planes, neighbouring runs differ in class.
    if (column_ > 0 && (top || ranges_ || next_.back().label != left_label)) {
      const bool at_edge = row > 0 && left > 0 && edges_[left - 1].row == row;
      if (coder_.code(situations_.goes_on(top, at_edge), label == left_label)) {
        label = left_label;
        return true;
      }
    }
    const std::span<AdaptiveBit, kLabelTree> tree =
        situations_.label(top ? kTopOfColumn : known_.place_of(next_.back().label));
    std::uint32_t place = 0;
    if constexpr (!Coder::kDecodes) place = known_.place_of(label);
    std::uint32_t node = 1;
    for (unsigned bit = 4; bit-- > 0;) {
      node = 2 * node + (coder_.code(tree[node], ((place >> bit) & 1U) != 0) ? 1U : 0U);
    }
    place = node & 15U;
    if (known_.has(place)) {
      label = known_.label_at(place);
    } else {
      label = static_cast<ClassId>(coder_.code_plain(label, 8));
      known_.add(label);
    }
    return false;
  }

  bool code_end(Edge& edge, std::int32_t end, std::size_t left, std::int32_t row, bool goes_on) {
    const std::size_t stop = std::min(edges_.size(), left + kCandidates);
    for (std::size_t i = left; i < stop; ++i) {
      const Edge& candidate = edges_[i];
      const bool last = candidate.row == rows_;
      const std::int32_t step = end - candidate.row;
      const bool near = last ? step == 0 : std::abs(step) <= kReach && end > row && end < rows_;
      AdaptiveBit& situation =
          situations_.ends_there(i - left, last, goes_on, candidate.label == edge.label);
      if (coder_.code(situation, near)) {
        edge.row = rows_;
        return last || follow(edge, candidate, code_short_step(step, goes_on, i - left), row);
      }
      if (last) break;
    }
    edge.row = code_row(end);
    return !Coder::kDecodes || (edge.row > row && edge.row <= rows_);
  }

  std::int32_t code_short_step(std::int32_t step, bool goes_on, std::size_t candidate) {
    if (!coder_.code(situations_.steps(goes_on, candidate), step != 0)) return 0;
    const bool down = coder_.code(situations_.steps_down(), step > 0);
    const std::int32_t size = coder_.code(situations_.steps_far(), std::abs(step) > 1) ? 2 : 1;
    return down ? size : -size;
  }

  /// Takes over the history of an edge to the left.
  bool follow(Edge& edge, const Edge& candidate, std::int32_t step, std::int32_t row) const {
    const ClassId label = edge.label;
    edge = candidate;
    edge.label = label;
    if (step != 0) move(edge, step);
    return !Coder::kDecodes || (edge.row > row && edge.row < rows_);
  }

  /// A row anywhere: its highest bits in a tree of situations, the others plain.
  std::int32_t code_row(std::int32_t row) {
    const unsigned modelled = std::min(row_bits_, kRowTreeBits);
    const unsigned plain = row_bits_ - modelled;
    std::uint32_t node = 1;
    for (unsigned bit = row_bits_; bit-- > plain;) {
      const bool one = ((static_cast<std::uint32_t>(row) >> bit) & 1U) != 0;
      node = 2 * node + (coder_.code(situations_.row(node), one) ? 1U : 0U);
    }
    const std::uint32_t high = node - (1U << modelled);
    const std::uint32_t low =
        coder_.code_plain(static_cast<std::uint32_t>(row) & ((1U << plain) - 1U), plain);
    return static_cast<std::int32_t>((high << plain) | low);
  }

  void code_planes(std::span<const RunPlane> planes, bool fresh) {
    if (fresh) {
      next_planes_.clear();
      for (const std::size_t left : matches_) {
        next_planes_.push_back(left == kNoMatch ? PlaneState() : plane_states_[left]);
      }
      std::swap(plane_states_, next_planes_);
    }
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      RunPlane plane;
      if constexpr (!Coder::kDecodes) plane = planes[i];
      planes_.code(coder_, edges_[i].label, plane, plane_states_[i]);
    }
  }

  /// When the edges, if they go on as they moved last, will move next.
  void find_next_due() {
    first_due_ = second_due_ = kLater;
    for (std::size_t i = 0; i + 1 < edges_.size(); ++i) {
      std::int32_t due = edges_[i].moved + std::max(1, edges_[i].period);
      if (due < column_ - 2) due = column_ + 3;  // it has come to rest
      if (due < first_due_) std::swap(due, first_due_);
      second_due_ = std::min(second_due_, due);
    }
  }
  std::int32_t due_in(std::int32_t due) const { return due - column_; }

  static constexpr std::int32_t kLater = 1 << 20;

  Coder& coder_;
  std::int32_t rows_;
  bool ranges_;
  unsigned row_bits_ = 0;
  std::int32_t column_ = 0;
  std::int32_t steady_columns_ = 99;  // since the last fresh one
  std::int32_t first_due_ = 0;
  std::int32_t second_due_ = 0;
  std::vector<Edge> edges_;  // of the column coded last
  std::vector<Edge> next_;
  std::vector<std::size_t> matches_;  // of a fresh column: which run to the left each one goes on
  std::vector<PlaneState> plane_states_;
  std::vector<PlaneState> next_planes_;
  KnownLabels known_;
  ViewSituations situations_;
  PlaneModel planes_;
};

}  // namespace semview::detail
