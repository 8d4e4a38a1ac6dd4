// SPDX-License-Identifier: Apache-2.0
/// Where an eye is in a plan.
#pragma once

#include <optional>

#include "semview/map/column_map.hpp"

namespace semview::map {

/// What keeps an eye from seeing a plan as a robot would; nothing of it is true of a cell's eye.
struct EyePlace {
  bool outside = false;            ///< of the building, or past the plan
  std::optional<ClassId> in_slab;  ///< the class of the slab that the eye is inside of
  bool above_ceiling = false;      ///< at its height or higher
};

/// `eye_z_m` in frame `map`.
EyePlace eye_place(const ColumnMap& plan, double x_m, double y_m, double eye_z_m);

}  // namespace semview::map
