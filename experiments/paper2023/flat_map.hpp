// SPDX-License-Identifier: Apache-2.0
/// The map of a flat: its survey, fused.
#pragma once

#include <memory>

#include "recording.hpp"
#include "semview/core/result.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/field/distance_field.hpp"
#include "semview/field/semantic_volume.hpp"

namespace semview::paper2023 {

/// Fuses every frame with the mapper's poses, which are not the true ones. Voxels of 5 cm,
/// truncation 20 cm. @errors those of fusion
Result<field::SemanticVolume> fuse_survey(const Recording& survey,
                                          LabelSource labels,
                                          ThreadPool& pool);

/// Its distances. @errors those of `field::distances_of_volume`
Result<std::shared_ptr<const field::DistanceField>> map_of(const Recording& survey,
                                                           LabelSource labels,
                                                           ThreadPool& pool);

}  // namespace semview::paper2023
