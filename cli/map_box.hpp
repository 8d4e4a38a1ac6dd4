// SPDX-License-Identifier: Apache-2.0
/// How large a map is.
#pragma once

#include <Eigen/Core>

#include "semview/map/semantic_map.hpp"

namespace semview::cli {

/// What the map takes up of frame `map`, metres; a plan reaches to its ceiling or highest slab.
struct Box {
  Eigen::Vector3d low;
  Eigen::Vector3d high;
};

Box box_of(const map::SemanticMap& map);

}  // namespace semview::cli
