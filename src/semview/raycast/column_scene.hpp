// SPDX-License-Identifier: Apache-2.0
/// An extruded plan, ready to be walked over.
#pragma once

#include "semview/map/column_map.hpp"
#include "semview/raycast/column_grid.hpp"

namespace semview::raycast {

/// A plan and its grid. Immutable.
class ColumnScene {
 public:
  static ColumnScene build(const map::ColumnMap& plan);

  const map::ColumnMap& plan() const { return plan_; }
  const ColumnGrid& grid() const { return grid_; }

 private:
  explicit ColumnScene(const map::ColumnMap& plan);
  map::ColumnMap plan_;
  ColumnGrid grid_;
};

}  // namespace semview::raycast
