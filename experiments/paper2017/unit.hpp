// SPDX-License-Identifier: Apache-2.0
/// What the experiment's threads take one at a time: a row on a world, with every method, start and
/// filter seed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "learned_weights.hpp"
#include "methods.hpp"
#include "records.hpp"
#include "rows.hpp"
#include "semview/core/result.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "world.hpp"

namespace semview::paper2017 {

/// What all units share.
struct UnitSettings {
  std::vector<Start> starts;
  int runs = 10;
  std::uint64_t seed = 1;
  std::string engine = "auto";
  std::filesystem::path plans;                   ///< where the undistorted plans were drawn
  std::optional<similarity::WeightMatrix> hand;  ///< set, as are those of `learned` that are used
  LearnedWeights learned;                        ///< as far as methods need them
};

/// The seed of a run's filter; runs count from 1.
std::uint64_t filter_seed(std::uint64_t seed, int run);

/// All drives of a row on a world, in the order of methods, starts, runs. Equal arguments give
/// equal records but for their times.
/// @errors those of maps and scoring.
/// @threads for several at once, each with its own arguments
Result<std::vector<TrialRecord>> run_unit(const UnitSettings& settings,
                                          const std::vector<Method>& methods,
                                          const Row& row,
                                          const World& world,
                                          std::uint64_t world_seed);

}  // namespace semview::paper2017
