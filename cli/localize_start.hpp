// SPDX-License-Identifier: Apache-2.0
/// Where `semview localize` lets its particles start.
#pragma once

#include <span>
#include <string>

#include "localize_options.hpp"
#include "semview/geometry/pose_grid.hpp"

namespace semview::cli {

/// --init as numbers.
struct KnownStart {
  Pose2 map_from_robot;
  double sigma_m = 0.0;
};

/// @errors kInvalidArgument, field `--init`.
Result<KnownStart> known_start(const std::string& init);

/// Around --init, which must lie near one of `free_cells`, or over them with --global.
/// @errors kInvalidArgument: --init is no pose or far from the map; kFailedPrecondition: no free
/// cell.
Result<localization::ParticleSet> first_particles(const LocalizeOptions& options,
                                                  std::span<const CellIndex> free_cells);

}  // namespace semview::cli
