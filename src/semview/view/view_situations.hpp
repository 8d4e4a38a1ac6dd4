// SPDX-License-Identifier: Apache-2.0
/// The situations of `ColumnWalk` and how likely yes is in each to begin with; for the sources of
/// this module.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "semview/semantics/class_table.hpp"
#include "semview/view/range_coder.hpp"

namespace semview::detail {

inline constexpr std::size_t kSizeBits = 7;
inline constexpr std::size_t kLabelTree = 16;
inline constexpr unsigned kRowTreeBits = 3;
inline constexpr std::uint32_t kTopOfColumn = 7;

/// The classes of a view in the order in which they came up, so that a situation can name one
/// without knowing the map.
class KnownLabels {
 public:
  static constexpr std::uint32_t kRoom = 15;

  KnownLabels() { places_.fill(kRoom); }
  bool has(std::uint32_t place) const { return place < count_; }
  ClassId label_at(std::uint32_t place) const { return labels_[place]; }
  /// The place of a new class is the next free one; `kRoom` once all are taken.
  std::uint32_t place_of(ClassId label) const {
    return std::min<std::uint32_t>(places_[label], count_);
  }
  void add(ClassId label) {
    if (count_ == kRoom || places_[label] != kRoom) return;
    places_[label] = static_cast<std::uint8_t>(count_);
    labels_[count_++] = label;
  }

 private:
  std::array<std::uint8_t, 256> places_;
  std::array<ClassId, kRoom> labels_{};
  std::uint32_t count_ = 0;
};

/// Each function names one situation; its arguments are what the walk knows there.
class ViewSituations {
 public:
  static constexpr std::size_t kCount = 128 + 4 + 384 + 6 + 28 + 4 + 128 + 24 + 6 + 2 + 8;

  /// With the likelihoods that views of buildings have shown, view_situations.cpp.
  ViewSituations();

  AdaptiveBit& unchanged(std::int32_t first_due_in, std::int32_t second_due_in, bool just_fresh) {
    const auto soon = [](std::int32_t due_in) {
      return static_cast<std::size_t>(std::clamp(due_in + 2, 0, 7));
    };
    return at(kUnchanged,
              (soon(first_due_in) * 8 + soon(second_due_in)) * 2 + (just_fresh ? 1 : 0));
  }
  AdaptiveBit& fresh(std::int32_t steady_columns) {
    return at(kFresh, steady_columns < 1 ? 0 : steady_columns < 3 ? 1 : steady_columns < 8 ? 2 : 3);
  }
  AdaptiveBit& moves(std::int32_t period, std::int32_t age, std::int32_t step, int others_moved) {
    const bool steep = step > 1 || step < -1 || (age == 1 && period == 1);
    const std::size_t rhythm = roughly(age) * 8 + roughly(std::max(period, age - 1));
    return at(kMoves, (rhythm * 3 + static_cast<std::size_t>(others_moved)) * 2 + (steep ? 1 : 0));
  }
  AdaptiveBit& down(std::int32_t last_step, std::int32_t age) {
    const std::size_t before = last_step < 0 ? 0 : last_step == 0 ? 1 : 2;
    return at(kDown, before * 2 + (age <= 2 ? 1 : 0));
  }
  std::span<AdaptiveBit, kSizeBits> size(std::int32_t last_size) {
    return some<kSizeBits>(kSize, static_cast<std::size_t>(std::min(3, last_size)) * kSizeBits);
  }
  AdaptiveBit& goes_on(bool top, bool at_edge) {
    return at(kGoesOn, (top ? 0U : 1U) + (at_edge ? 2U : 0U));
  }
  std::span<AdaptiveBit, kLabelTree> label(std::uint32_t place_above) {
    const std::uint32_t row = place_above == kTopOfColumn ? 7U : std::min(place_above, 6U);
    return some<kLabelTree>(kLabel, row * kLabelTree);
  }
  AdaptiveBit& ends_there(std::size_t candidate, bool last, bool goes_on, bool same_class) {
    return at(kEndsThere,
              candidate * 8 + (last ? 4U : 0U) + (goes_on ? 2U : 0U) + (same_class ? 1U : 0U));
  }
  AdaptiveBit& steps(bool goes_on, std::size_t candidate) {
    return at(kSteps, (goes_on ? 3U : 0U) + candidate);
  }
  AdaptiveBit& steps_down() { return at(kStepsDown, 0); }
  AdaptiveBit& steps_far() { return at(kStepsFar, 0); }
  AdaptiveBit& row(std::uint32_t node) { return at(kRow, node); }

  /// Where a situation stands in the table of likelihoods; `kCount` or more if it is none of these.
  std::size_t place_of(const AdaptiveBit& situation) const {
    return static_cast<std::size_t>(&situation - bits_.data());
  }

 private:
  // First places in `bits_`.
  static constexpr std::size_t kUnchanged = 0;
  static constexpr std::size_t kFresh = kUnchanged + 128;
  static constexpr std::size_t kMoves = kFresh + 4;
  static constexpr std::size_t kDown = kMoves + 384;
  static constexpr std::size_t kSize = kDown + 6;
  static constexpr std::size_t kGoesOn = kSize + 4 * kSizeBits;
  static constexpr std::size_t kLabel = kGoesOn + 4;
  static constexpr std::size_t kEndsThere = kLabel + 8 * kLabelTree;
  static constexpr std::size_t kSteps = kEndsThere + 24;
  static constexpr std::size_t kStepsDown = kSteps + 6;
  static constexpr std::size_t kStepsFar = kStepsDown + 1;
  static constexpr std::size_t kRow = kStepsFar + 1;
  static_assert(kRow + 8 == kCount);

  /// Of a number of columns, one of eight.
  static std::size_t roughly(std::int32_t columns) {
    constexpr std::array<std::uint8_t, 16> kRough = {
        0, 0, 1, 2, 3, 4, 4, 5, 5, 5, 6, 6, 6, 6, 6, 6};
    return columns < 16 ? kRough[static_cast<std::size_t>(columns)] : 7;
  }
  AdaptiveBit& at(std::size_t first, std::size_t place) { return bits_[first + place]; }
  template <std::size_t Count>
  std::span<AdaptiveBit, Count> some(std::size_t first, std::size_t place) {
    return std::span<AdaptiveBit, Count>(bits_.data() + first + place, Count);
  }

  std::array<AdaptiveBit, kCount> bits_;
};

}  // namespace semview::detail
