// SPDX-License-Identifier: Apache-2.0
#include "semview/map/column_builder.hpp"

#include <algorithm>
#include <limits>

namespace semview::map::detail {
namespace {

void add_slab(ColumnProfile& profile, Slab slab, const Storey& storey) {
  const double top_m =
      storey.ceiling ? storey.ceiling->height_m : std::numeric_limits<double>::infinity();
  slab.z_min_m = std::max(slab.z_min_m, storey.ground_height_m);
  slab.z_max_m = std::min(slab.z_max_m, top_m);
  if (!(slab.z_min_m < slab.z_max_m)) return;
  if (!profile.slabs.empty()) {
    Slab& last = profile.slabs.back();
    if (last.label == slab.label && last.z_max_m == slab.z_min_m) {
      last.z_max_m = slab.z_max_m;
      return;
    }
  }
  profile.slabs.push_back(slab);
}

}  // namespace

ColumnProfile column_profile(const std::vector<MapClass>& classes,
                             const ClassTable& table,
                             ClassId id,
                             const Storey& storey) {
  return column_profile(classes, table, classes[id - 1U], storey);
}

ColumnProfile column_profile(const std::vector<MapClass>& classes,
                             const ClassTable& table,
                             const MapClass& own,
                             const Storey& storey) {
  const ClassId id = table.id(own.name).value_or(kNoHit);
  const bool paint = own.min_height_m == own.max_height_m;
  ColumnProfile profile;
  profile.passable = own.passable;
  profile.ground = paint ? id : storey.ground_label;
  if (const std::optional<ClassId> below = table.id(own.below)) {
    const double low_m = classes[*below - 1U].min_height_m;
    add_slab(profile, {low_m, own.min_height_m, *below}, storey);
  }
  add_slab(profile, {own.min_height_m, own.max_height_m, id}, storey);
  if (const std::optional<ClassId> above = table.id(own.above)) {
    const double high_m = classes[*above - 1U].max_height_m;
    add_slab(profile, {own.max_height_m, high_m, *above}, storey);
  }
  return profile;
}

}  // namespace semview::map::detail
