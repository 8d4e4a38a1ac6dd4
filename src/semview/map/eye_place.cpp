// SPDX-License-Identifier: Apache-2.0
#include "semview/map/eye_place.hpp"

namespace semview::map {

EyePlace eye_place(const ColumnMap& plan, double x_m, double y_m, double eye_z_m) {
  EyePlace place;
  place.above_ceiling = plan.ceiling && eye_z_m >= plan.ceiling->height_m;
  const ColumnProfile* profile = plan.at(x_m, y_m);
  if (profile == nullptr || profile->outside) {
    place.outside = true;
    return place;
  }
  for (const Slab& slab : profile->slabs) {
    if (eye_z_m > slab.z_min_m && eye_z_m < slab.z_max_m) place.in_slab = slab.label;
  }
  return place;
}

}  // namespace semview::map
