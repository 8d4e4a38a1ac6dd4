// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/prefix_table.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "semview/core/random.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "support/only_target.hpp"

namespace semview::similarity {
namespace {

/// Random labels 0 to `largest`, and some unknown ones.
LabelImage labels_to(Rng& rng, int rows, int columns, std::uint64_t largest) {
  LabelImage labels(rows, columns);
  for (ClassId& label : labels.pixels()) {
    label = rng.uniform() < 0.1 ? kUnknown : static_cast<ClassId>(rng.below(largest + 1));
  }
  return labels;
}

/// Weights [class][label] that fill 16 bits as they may; none of labels that are not scored.
std::vector<std::int16_t> random_integers(Rng& rng, int classes, int rows) {
  std::vector<std::int16_t> weights(256 * static_cast<std::size_t>(classes));
  const std::int64_t most = 32767 / rows;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (i % 256 == kNoHit || i % 256 == kUnknown) continue;
    weights[i] = static_cast<std::int16_t>(
        static_cast<std::int64_t>(rng.below(static_cast<std::uint64_t>(2 * most + 1))) - most);
  }
  return weights;
}

/// Every entry, pixel by pixel.
void expect_literal(const PrefixTable& table,
                    const LabelImage& labels,
                    const std::vector<const std::int16_t*>& weights_of_row,
                    const std::string& circumstances) {
  std::size_t wrong = 0;
  for (int j = 0; j < table.classes(); ++j) {
    for (int residue = 0; residue < table.residues(); ++residue) {
      for (std::size_t g = 0; g < table.width(); ++g) {
        int sum = 0;
        for (int r = 0; r <= table.rows(); ++r) {
          const std::size_t at = static_cast<std::size_t>(r) * table.row_stride() +
                                 static_cast<std::size_t>(j) * table.class_stride() +
                                 static_cast<std::size_t>(residue) * table.width() + g;
          if (table.entries()[at] != sum) ++wrong;
          if (r == table.rows() || g >= static_cast<std::size_t>(table.groups())) continue;
          const int column =
              (table.first_group() + static_cast<int>(g)) * table.residues() + residue;
          sum += weights_of_row[static_cast<std::size_t>(r)][256 * j + labels.at(r, column)];
        }
      }
    }
  }
  EXPECT_EQ(wrong, 0U) << circumstances;
}

TEST(PrefixTableTest, EveryEntryIsTheSumOfWhatIsAboveItOnEveryTarget) {
  constexpr int kRows = 13;
  constexpr int kClasses = 4;
  Rng rng(1);
  const std::vector<std::int16_t> upper = random_integers(rng, kClasses, kRows);
  const std::vector<std::int16_t> lower = random_integers(rng, kClasses, kRows);
  std::vector<const std::int16_t*> weights_of_row(kRows, lower.data());
  for (std::size_t r = 0; r < 5; ++r) weights_of_row[r] = upper.data();
  struct Part {
    int first_group, groups;
  };
  // As many labels as there are, and about one table and two of them full.
  for (const std::uint64_t largest : {1U, 15U, 16U, 31U, 32U, 150U, 254U}) {
    for (const Part part : {Part{0, 120}, Part{7, 33}, Part{50, 20}, Part{10, 96}}) {
      for (const int columns : {120, 360}) {
        const LabelImage labels = labels_to(rng, kRows, columns, largest);
        for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
          const OnlyTarget only(target);
          PrefixTable table(kRows, columns, kClasses, part.first_group, part.groups);
          table.fill(labels, weights_of_row);
          expect_literal(table,
                         labels,
                         weights_of_row,
                         std::string(hwy::TargetName(target)) + ", labels to " +
                             std::to_string(largest) + ", groups " + std::to_string(part.groups));
        }
      }
    }
  }
}

}  // namespace
}  // namespace semview::similarity
