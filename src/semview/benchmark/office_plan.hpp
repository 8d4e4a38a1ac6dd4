// SPDX-License-Identifier: Apache-2.0
/// Plans made by a program: furnished offices of any size, for benchmarks and tests.
#pragma once

#include <cstdint>
#include <filesystem>

#include "semview/core/result.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::benchmark {

/// A storey of corridors and rooms. Equal values give equal plans on every machine.
struct OfficePlan {
  double width_m = 40.0;
  double depth_m = 25.0;
  double resolution_m = 0.05;
  int classes = 11;  ///< floor, ceiling, wall, door, window, lintel and furniture
  std::uint64_t seed = 1;
};

inline constexpr int kFewestOfficeClasses = 7;
inline constexpr int kMostOfficeClasses = 120;

/// Bands of 12.5 m, each a corridor between two rows of rooms, and a corridor across in the middle.
/// Doors are closed or leave a way under their lintel, windows have a sill; each room has
/// eight pieces of furniture, turned any way: things one can see under, round things, things taller
/// than the eye. Resolution and class count (from 11 up) do not change what stands where.
/// @errors kInvalidArgument: sizes not in 5..2000 m, a resolution not in 0.005..0.2 m, more than
/// 400 million pixels, classes not in 7..120.
Result<map::SemanticMap> draw_office(const OfficePlan& plan);

/// The same plan as a map bundle; loading it gives an equal fingerprint.
/// @errors those of `draw_office`; kUnavailable: cannot be written.
Status write_office(const OfficePlan& plan, const std::filesystem::path& directory);

}  // namespace semview::benchmark
