// SPDX-License-Identifier: Apache-2.0
/// Weights learned on the training worlds, and on no other.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "plan_drawing.hpp"
#include "semview/core/result.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "world.hpp"

namespace semview::paper2017 {

/// The worlds `kFirstTrainingWorld` to `kLastTrainingWorld`, in order.
std::vector<World> make_training_worlds(const WorldConfig& config, ThreadPool& pool);

/// Log-likelihood ratios from the training worlds' panoramas against undistorted, stacked plans of
/// a class subset, seen from where the robot truly stood.
/// @param training   of `make_training_worlds`
/// @param directory  where the plans are drawn
/// @errors those of drawing, loading and casting.
Result<similarity::WeightMatrix> learn_weights(std::span<const World> training,
                                               ClassSubset classes,
                                               const std::filesystem::path& directory,
                                               const std::string& engine);

}  // namespace semview::paper2017
