// SPDX-License-Identifier: Apache-2.0
/// The classes that a run of a fresh column may have; for the sources of this module.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "semview/semantics/class_table.hpp"
#include "semview/view/view_situations.hpp"

namespace semview::detail {

inline constexpr std::uint32_t kTopOfColumn = 256;  ///< in place of the class above

/// Names classes without knowing the map: a few by where they stand, others by how long ago they
/// came up in this view.
class KnownLabels {
 public:
  KnownLabels() { followers_.fill(kNone); }

  /// Begins anew for a run, which cannot be of the class `impossible`.
  void ask(std::uint32_t impossible) {
    impossible_ = impossible;
    suggested_ = 0;
  }
  /// @returns false if the run cannot be of this class or it was suggested already.
  bool suggest(std::uint32_t label) {
    if (excluded(label)) return false;
    suggestions_[suggested_++] = static_cast<ClassId>(label);
    return true;
  }
  /// The class that stood below `above` last.
  void suggest_follower_of(std::uint32_t above) {
    if (followers_[above] != kNone) suggest(followers_[above]);
  }
  std::uint32_t suggested() const { return suggested_; }

  /// Writes or reads a class.
  template <typename Coder>
  ClassId code(Coder& coder, Situation situation, ClassId label) {
    std::uint32_t symbol = kLabelElsewhere;
    std::uint32_t place = 0;
    std::array<ClassId, kKnownLabels> others{};
    std::uint32_t count = 0;
    if constexpr (!Coder::kDecodes) {
      symbol = 0;
      while (symbol < suggested_ && suggestions_[symbol] != label) ++symbol;
      if (symbol == suggested_) {
        count = list_others(others);
        while (place < count && others[place] != label) ++place;
        symbol = place < count ? kLabelKnown : kLabelElsewhere;
      }
    }
    symbol = coder.code(situation, symbol);
    // A situation leaves some room for suggestions that are not there.
    if (symbol < kLabelCandidates) return suggestions_[symbol];
    if (symbol == kLabelElsewhere) return static_cast<ClassId>(coder.plain(label, 8));
    if constexpr (Coder::kDecodes) count = list_others(others);
    return others[coder.code(ViewSituations::known(count), place)];
  }

  /// A run of this class was coded below one of `above`.
  void note(std::uint32_t above, ClassId label) {
    followers_[above] = label;
    ClassId moved_back = label;
    for (std::uint32_t i = 0; i < kKnownLabels; ++i) {
      std::swap(labels_[i], moved_back);
      if (i == count_) {
        ++count_;
        return;
      }
      if (moved_back == label) return;
    }
  }

 private:
  static constexpr std::uint16_t kNone = 256;

  bool excluded(std::uint32_t label) const {
    if (label == impossible_) return true;
    for (std::uint32_t i = 0; i < suggested_; ++i) {
      if (suggestions_[i] == label) return true;
    }
    return false;
  }
  std::uint32_t list_others(std::array<ClassId, kKnownLabels>& others) const {
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (!excluded(labels_[i])) others[count++] = labels_[i];
    }
    return count;
  }

  std::uint32_t impossible_ = kTopOfColumn;
  std::uint32_t suggested_ = 0;
  std::array<ClassId, kLabelCandidates> suggestions_{};
  std::array<std::uint16_t, kTopOfColumn + 1> followers_{};
  std::array<ClassId, kKnownLabels> labels_{};  // the latest first
  std::uint32_t count_ = 0;
};

}  // namespace semview::detail
