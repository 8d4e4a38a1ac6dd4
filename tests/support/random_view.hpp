// SPDX-License-Identifier: Apache-2.0
/// Views for tests of what keeps, sends or scores them.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

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

/// As `random_view`, with ranges: walls that turn away from column to column, floors, slopes, and
/// runs of one class that lie on two surfaces.
inline ColumnView random_view_with_ranges(std::uint64_t seed, int columns, int rows) {
  const ColumnView labels = random_view(seed, columns, rows);
  Rng rng(seed, "random_view_with_ranges");
  std::vector<std::uint32_t> first_run = {0};
  std::vector<Run> runs;
  std::vector<RunPlane> planes;
  for (int c = 0; c < columns; ++c) {
    const double azimuth = c * 6.283185307179586 / columns;
    int start = 0;
    for (const Run& run : labels.column(c)) {
      const auto tilt = static_cast<float>(run.label % 3);
      const auto wall = static_cast<float>(0.5 + 0.2 * std::cos(azimuth - run.label));
      RunPlane plane{run.label % 2 == 1 ? wall : 0.0F, run.label % 2 == 1 ? tilt : -0.8F - tilt};
      if (run.label == kNoHit) plane = {};
      if (run.label != kNoHit && run.end_row - start > 1 && rng.uniform() < 0.1) {
        runs.push_back({static_cast<std::uint16_t>(start + 1), run.label});
        planes.push_back({static_cast<float>(0.1 + rng.uniform()), 1.5F});
      }
      runs.push_back(run);
      planes.push_back(plane);
      start = run.end_row;
    }
    first_run.push_back(static_cast<std::uint32_t>(runs.size()));
  }
  return *ColumnView::from_runs(rows, std::move(first_run), std::move(runs), std::move(planes));
}

inline SharedView shared_random_view(std::uint64_t seed, int columns = 120, int rows = 12) {
  return std::make_shared<const ColumnView>(random_view(seed, columns, rows));
}

}  // namespace semview::testing
