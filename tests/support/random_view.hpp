// SPDX-License-Identifier: Apache-2.0
/// Views for tests of what keeps, sends or scores them.
#pragma once

#include <cstdint>
#include <memory>

#include "semview/core/random.hpp"
#include "semview/view/column_view.hpp"

namespace semview::testing {

/// A view of `columns` × `rows` with up to `classes` classes in runs that mostly go on from column
/// to column, as in a building; the same seed gives the same view.
inline ColumnView random_view(std::uint64_t seed, int columns, int rows, int classes = 6) {
  Rng rng(seed, "random_view");
  LabelImage labels(rows, columns);
  for (int c = 0; c < columns; ++c) {
    const bool fresh = c == 0 || rng.uniform() < 0.2;
    for (int r = 0; r < rows; ++r) {
      const bool from_above = r > 0 && rng.uniform() < 0.8;
      if (from_above && fresh) {
        labels.at(r, c) = labels.at(r - 1, c);
      } else if (!fresh && rng.uniform() < 0.95) {
        labels.at(r, c) = labels.at(r, c - 1);
      } else {
        labels.at(r, c) = static_cast<ClassId>(rng.below(static_cast<std::uint64_t>(classes) + 1));
      }
    }
  }
  return ColumnView::from_labels(labels);
}

inline SharedView shared_random_view(std::uint64_t seed, int columns = 120, int rows = 12) {
  return std::make_shared<const ColumnView>(random_view(seed, columns, rows));
}

}  // namespace semview::testing
