// SPDX-License-Identifier: Apache-2.0
/// From classes with heights to column profiles. Inside the module only.
#pragma once

#include <vector>

#include "semview/map/column_map.hpp"
#include "semview/map/map_class.hpp"
#include "semview/semantics/class_table.hpp"

namespace semview::map::detail {

/// The solid storey that profiles are cut to.
struct Storey {
  double ground_height_m = 0.0;
  ClassId ground_label = kNoHit;
  std::optional<Ceiling> ceiling;
};

/// The column over a pixel of class `id`: its own slab, `below` and `above` it what they name, all
/// cut at ground and ceiling; touching slabs of one class are one. A class whose two heights are
/// the ground's is paint: it becomes the ground. `above` and `below` name classes of `classes`.
ColumnProfile column_profile(const std::vector<MapClass>& classes,
                             const ClassTable& table,
                             ClassId id,
                             const Storey& storey);

/// The column of a class whose heights, `above` and `below` are those of `own`, not of the list.
ColumnProfile column_profile(const std::vector<MapClass>& classes,
                             const ClassTable& table,
                             const MapClass& own,
                             const Storey& storey);

}  // namespace semview::map::detail
