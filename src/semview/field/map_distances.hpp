// SPDX-License-Identifier: Apache-2.0
/// The distances of a loaded map, and the model of the 2023 paper on it.
#pragma once

#include <memory>

#include "semview/core/result.hpp"
#include "semview/field/distance_field.hpp"
#include "semview/field/field_model.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/view/score_model.hpp"

namespace semview::field {

/// How far everything on a map is: of its volume, if it was fused, else of its plan.
/// @errors kFailedPrecondition: a mesh without a volume; those of reading the volume.
Result<std::shared_ptr<const DistanceField>> distances_of_map(const map::SemanticMap& map);

/// @param classes  of the distances, which may be in another order than the map's
FieldModelConfig field_model(const DepthScoring& scoring,
                             const map::SemanticMap& map,
                             const ClassTable& classes);

}  // namespace semview::field
