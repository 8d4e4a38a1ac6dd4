// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/prefix_table.hpp"

#include "semview/geometry/pose_grid.hpp"

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
  const auto groups = static_cast<std::size_t>(groups_);
  const auto residues = static_cast<std::size_t>(residues_);
  const auto first = static_cast<std::size_t>(first_group_);
  std::array<ClassId, PoseGrid::kHeadings> seen{};
  for (int r = 0; r < rows_; ++r) {
    const auto row = labels.row(r);
    for (std::size_t residue = 0; residue < residues; ++residue) {
      for (std::size_t g = 0; g < groups; ++g) seen[g] = row[(first + g) * residues + residue];
      const std::int16_t* weights = weights_of_row[static_cast<std::size_t>(r)];
      const std::int16_t* above =
          blocks_.data()->data() + static_cast<std::size_t>(r) * row_stride() + residue * width_;
      std::int16_t* below = blocks_.data()->data() +
                            static_cast<std::size_t>(r + 1) * row_stride() + residue * width_;
      for (int j = 0; j < classes_; ++j) {
        for (std::size_t g = 0; g < groups; ++g) {
          below[g] = static_cast<std::int16_t>(above[g] + weights[seen[g]]);
        }
        weights += 256;
        above += class_stride();
        below += class_stride();
      }
    }
  }
}

}  // namespace semview::similarity
