// SPDX-License-Identifier: Apache-2.0
/// What keeps the experiment honest: no world serves for two purposes. That nobody renders both
/// what the camera sees and what the map predicts is for tests to see: the camera's sources include
/// nothing of the map's.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "methods.hpp"
#include "semview/core/result.hpp"

namespace semview::paper2017 {

/// What a world may be used for, by its seed.
enum class WorldUse {
  kTest,        ///< 1..100: results
  kTraining,    ///< 101..106: weights are learned
  kValidation,  ///< 201..205: settings are chosen
};

inline constexpr std::uint64_t kLastTestWorld = 100;
inline constexpr std::uint64_t kFirstTrainingWorld = 101;
inline constexpr std::uint64_t kLastTrainingWorld = 106;
inline constexpr std::uint64_t kFirstValidationWorld = 201;
inline constexpr std::uint64_t kLastValidationWorld = 205;

/// "test", "training" or "validation".
std::string_view name(WorldUse use);

/// The one use of the worlds of a table.
/// @errors kInvalidArgument: no world, a seed of no use, a training world (its errors would be
/// those of examples that were learned by heart), test and validation worlds together, or a world
/// twice.
Result<WorldUse> check_worlds(std::span<const std::uint64_t> worlds);

/// What is named twice would be counted twice: averages over copies, columns that repeat.
/// @errors kInvalidArgument with field `option`: two of `values` are equal.
Status check_each_once(std::string_view option, std::span<const std::string> values);

/// @errors kInvalidArgument, field `--starts`: no start, or one twice.
Status check_starts(std::span<const Start> starts);

/// Who renders what, from what, as reports say it.
struct Provenance {
  std::string observation_scene;     ///< what the camera looks at
  std::string observation_renderer;  ///< who casts its rays
  std::string map_scene;
  std::string map_renderer;
};

// What this experiment's camera looks at, who casts its rays, and what its maps are made of.
inline constexpr const char* kObservationScene = "solids built from the layout";
inline constexpr const char* kObservationRenderer = "a ray caster of oriented primitives";
inline constexpr const char* kMapScene =
    "a plan drawn of the layout with a person's errors, extruded";

/// One line for reports.
std::string to_text(const Provenance& provenance);

}  // namespace semview::paper2017
