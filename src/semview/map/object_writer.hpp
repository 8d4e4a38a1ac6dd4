// SPDX-License-Identifier: Apache-2.0
/// Writes the objects of a plan as GeoJSON. Inside the module only.
#pragma once

#include <string>

#include "semview/map/semantic_map.hpp"

namespace semview::map::detail {

/// The text of an `objects.geojson` that gives a drawn map's pixels the profiles that objects gave
/// them, one feature a profile, its pixels as rectangles; "" if no pixel has such a profile.
std::string objects_text(const SemanticMap& map);

}  // namespace semview::map::detail
