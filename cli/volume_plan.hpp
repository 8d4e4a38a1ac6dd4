// SPDX-License-Identifier: Apache-2.0
/// A semantic volume seen from above.
#pragma once

#include "semview/field/semantic_volume.hpp"
#include "semview/picture/class_plan_picture.hpp"

namespace semview::cli {

/// The class of the highest voxel with one in each column of the volume, as if everything from
/// `top_m` above the ground (lamps, the ceiling, what noise leaves) were taken off; white where
/// there is none.
picture::ClassPlanPicture volume_plan(const field::SemanticVolume& volume,
                                      double ground_height_m,
                                      double top_m);

}  // namespace semview::cli
