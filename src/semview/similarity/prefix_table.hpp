// SPDX-License-Identifier: Apache-2.0
/// Vertical prefix sums of an observation: what a run of a view scores, by two look-ups.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "semview/view/column_view.hpp"

namespace semview::similarity {

/// P[row 0..rows][map class][residue][group]: the sum of the integer weights of one column's
/// observed pixels above `row`, as if the whole map were of one class.
///
/// Observed column c is group c / residues of residue c % residues, so that a turn by one heading
/// of the PoseGrid is a step of one group, and the columns that one column of a view meets at all
/// headings lie together. Only the groups from the first observed one to the last are kept.
///
/// The sum over one column fits 16 bits whatever the view; sums on the way there may wrap.
class PrefixTable {
 public:
  /// Groups of one table row are padded with zeros to a multiple of this, 64 bytes.
  static constexpr std::size_t kBlock = 32;

  PrefixTable() = default;
  /// All zero. @param columns  A multiple of 120.
  PrefixTable(int rows, int columns, int classes, int first_group, int groups);

  int rows() const { return rows_; }
  int residues() const { return residues_; }
  int classes() const { return classes_; }  ///< of the map, class 0 included
  int first_group() const { return first_group_; }
  int groups() const { return groups_; }

  /// Groups of a table row, padded; what follows are distances in `entries()`.
  std::size_t width() const { return width_; }
  std::size_t class_stride() const { return static_cast<std::size_t>(residues_) * width_; }
  std::size_t row_stride() const { return static_cast<std::size_t>(classes_) * class_stride(); }
  std::size_t byte_size() const { return blocks_.capacity() * sizeof(Block); }
  static std::size_t bytes_for(int rows, int columns, int classes, int groups);

  /// Aligned to 64 bytes.
  const std::int16_t* entries() const { return blocks_.data()->data(); }

  /// @param weights_of_row  For each row integer weights [map class][label], 256 labels; those that
  ///        are not scored have zeros.
  void fill(const LabelImage& labels, std::span<const std::int16_t* const> weights_of_row);

 private:
  struct alignas(64) Block : std::array<std::int16_t, kBlock> {};

  int rows_ = 0;
  int residues_ = 1;
  int classes_ = 0;
  int first_group_ = 0;
  int groups_ = 0;
  std::size_t width_ = 0;
  std::vector<Block> blocks_;
};

}  // namespace semview::similarity
