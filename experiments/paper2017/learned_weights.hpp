// SPDX-License-Identifier: Apache-2.0
/// Weights learned on the training worlds, and on no other.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
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
/// @param bands      of elevation
/// @param training   of `make_training_worlds`
/// @param directory  where the plans are drawn
/// @errors those of drawing, loading and casting.
Result<similarity::WeightMatrix> learn_weights(std::span<const World> training,
                                               ClassSubset classes,
                                               int bands,
                                               const std::filesystem::path& directory,
                                               const std::string& engine);

/// By class subset and number of elevation bands.
using LearnedWeights = std::map<std::pair<ClassSubset, int>, similarity::WeightMatrix>;

/// `learn_weights` of each subset with each of its numbers of bands.
Result<LearnedWeights> learn_weights(std::span<const World> training,
                                     const std::map<ClassSubset, std::set<int>>& kinds,
                                     const std::filesystem::path& directory,
                                     const std::string& engine,
                                     ThreadPool& pool);

}  // namespace semview::paper2017
