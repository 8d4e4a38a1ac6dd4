// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/prefix_table.hpp"

#include "semview/geometry/pose_grid.hpp"
#include "semview/similarity/prefix_fill.hpp"

namespace semview::similarity {
namespace {

constexpr std::size_t padded(int groups) {
  return (static_cast<std::size_t>(groups) + PrefixTable::kBlock - 1) / PrefixTable::kBlock *
         PrefixTable::kBlock;
}

}  // namespace

PrefixTable::PrefixTable(int rows, int columns, int classes, int first_group, int groups)
    : rows_(rows),
      residues_(columns / PoseGrid::kHeadings),
      classes_(classes),
      first_group_(first_group),
      groups_(groups),
      width_(padded(groups)),
      blocks_((static_cast<std::size_t>(rows) + 1) * row_stride() / kBlock) {}

std::size_t PrefixTable::bytes_for(int rows, int columns, int classes, int groups) {
  return (static_cast<std::size_t>(rows) + 1) * static_cast<std::size_t>(classes) *
         static_cast<std::size_t>(columns / PoseGrid::kHeadings) * padded(groups) *
         sizeof(std::int16_t);
}

void PrefixTable::fill(const LabelImage& labels,
                       std::span<const std::int16_t* const> weights_of_row) {
  fill_prefix_entries({blocks_.data()->data(), residues_, classes_, first_group_, groups_, width_},
                      labels,
                      weights_of_row);
}

}  // namespace semview::similarity
