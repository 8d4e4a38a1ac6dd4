// SPDX-License-Identifier: Apache-2.0
#include "guard.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>

namespace semview::paper2017 {
namespace {

std::optional<WorldUse> use_of(std::uint64_t world) {
  if (world >= 1 && world <= kLastTestWorld) return WorldUse::kTest;
  if (world >= kFirstTrainingWorld && world <= kLastTrainingWorld) return WorldUse::kTraining;
  if (world >= kFirstValidationWorld && world <= kLastValidationWorld) return WorldUse::kValidation;
  return std::nullopt;
}

tl::unexpected<Error> refuse(std::string message) {
  return fail(Error{ErrorCode::kInvalidArgument, std::move(message), "--worlds"});
}

}  // namespace

std::string_view name(WorldUse use) {
  switch (use) {
    case WorldUse::kTest:
      return "test";
    case WorldUse::kTraining:
      return "training";
    case WorldUse::kValidation:
      return "validation";
  }
  return "";
}

Result<WorldUse> check_worlds(std::span<const std::uint64_t> worlds) {
  if (worlds.empty()) return refuse("--worlds: none; expected a range, for example 1..6");
  const std::optional<WorldUse> first = use_of(worlds.front());
  for (const std::uint64_t world : worlds) {
    const std::optional<WorldUse> use = use_of(world);
    if (!use) {
      return refuse(
          fmt::format("--worlds: {} is no world; expected 1..{} (test) or {}..{} (validation)",
                      world,
                      kLastTestWorld,
                      kFirstValidationWorld,
                      kLastValidationWorld));
    }
    if (*use == WorldUse::kTraining) {
      return refuse(
          fmt::format("--worlds: weights are learned on world {}; expected 1..{} (test) "
                      "or {}..{} (validation)",
                      world,
                      kLastTestWorld,
                      kFirstValidationWorld,
                      kLastValidationWorld));
    }
    if (std::ranges::count(worlds, world) > 1) {
      return refuse(fmt::format("--worlds: {} is named twice; expected each once", world));
    }
    if (use != first) {
      return refuse(fmt::format("--worlds: {} is a {} world and {} a {} world; expected one kind",
                                worlds.front(),
                                name(*first),
                                world,
                                name(*use)));
    }
  }
  return *first;
}

Status check_each_once(std::string_view option, std::span<const std::string> values) {
  for (const std::string& value : values) {
    if (std::ranges::count(values, value) == 1) continue;
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("{}: {} is named twice; expected each once", option, value),
                      std::string(option)});
  }
  return {};
}

Status check_starts(std::span<const Start> starts) {
  if (starts.empty()) {
    return fail(
        Error{ErrorCode::kInvalidArgument, "--starts: expected local, global or both", "--starts"});
  }
  std::vector<std::string> names;
  for (const Start start : starts) names.emplace_back(name(start));
  return check_each_once("--starts", names);
}

std::string to_text(const Provenance& provenance) {
  return fmt::format("observations: {}, cast by {}; map: {}, cast by {}",
                     provenance.observation_scene,
                     provenance.observation_renderer,
                     provenance.map_scene,
                     provenance.map_renderer);
}

}  // namespace semview::paper2017
