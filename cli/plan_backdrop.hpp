// SPDX-License-Identifier: Apache-2.0
/// A map's plan as the background of pictures.
#pragma once

#include "semview/map/semantic_map.hpp"
#include "semview/picture/plan.hpp"

namespace semview::cli {

/// The plan in quiet colours, floor nearly white, so that what is drawn on it stands out.
/// @errors kFailedPrecondition: a mesh map, which has no plan.
Result<picture::Plan> plan_backdrop(const map::SemanticMap& map);

}  // namespace semview::cli
