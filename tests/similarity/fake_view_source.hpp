// SPDX-License-Identifier: Apache-2.0
/// A ViewSource of random views that counts how often each cell was asked for.
#pragma once

#include <map>
#include <memory>
#include <mutex>

#include <fmt/format.h>

#include "semview/view/view_source.hpp"
#include "similarity/random_scene.hpp"

namespace semview::similarity {

/// Cells with ix divisible by 7 have no view.
class FakeViewSource final : public ViewSource {
 public:
  explicit FakeViewSource(int classes) : classes_(classes) {
    profile_.camera.columns = 120;
    profile_.camera.rows = 12;
  }

  const ViewProfile& profile() const override { return profile_; }
  Result<ViewBatch> views(std::span<const CellIndex> cells) override {
    const std::scoped_lock lock(mutex_);
    ViewBatch batch;
    for (const CellIndex& cell : cells) {
      ++asked_[cell];
      ++batch.origins.cast;
      batch.views.push_back(view(cell));
    }
    return batch;
  }

  /// A distorted map's views have nothing to do with those of the map as it is drawn.
  Result<ViewBatch> undistorted_views(std::span<const CellIndex> cells,
                                      const MapAffine& affine) override {
    if (affine.is_identity()) return views(cells);
    ViewBatch batch;
    for (const CellIndex& cell : cells) batch.views.push_back(view(cell, affine));
    batch.origins.cast = cells.size();
    return batch;
  }

  SharedView view(const CellIndex& cell, const MapAffine& affine = {}) const {
    if (cell.ix % 7 == 0) return nullptr;
    Rng rng(static_cast<std::uint64_t>(cell.ix + 1000),
            fmt::format("view {} {} {}", affine.a, affine.b, affine.k),
            static_cast<std::uint64_t>(cell.iy + 1000));
    return std::make_shared<const ColumnView>(
        ColumnView::from_labels(random_labels(rng, profile_.camera, classes_)));
  }
  const std::map<CellIndex, int>& asked() const { return asked_; }

 private:
  ViewProfile profile_;
  int classes_;
  std::mutex mutex_;
  std::map<CellIndex, int> asked_;
};

}  // namespace semview::similarity
