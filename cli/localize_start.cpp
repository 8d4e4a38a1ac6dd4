// SPDX-License-Identifier: Apache-2.0
#include "localize_start.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "semview/geometry/angle.hpp"
#include "semview/localization/initialization.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

/// Past this a start is better called unknown.
constexpr double kMostSigma_m = 100.0;
/// How far from free space a start may lie however sure it is: robots stand close to things.
constexpr double kLeastReach_m = 0.5;

tl::unexpected<Error> no_start(const std::string& message) {
  return fail(Error{ErrorCode::kInvalidArgument, "--init: " + message, "--init"});
}

/// A start from which no particle can be right is a slip of the hand.
Status check_reaches(const KnownStart& start, std::span<const CellIndex> free_cells) {
  const double reach_m = std::max(3.0 * start.sigma_m, kLeastReach_m);
  double nearest_m = std::numeric_limits<double>::infinity();
  Pose2 low{nearest_m, nearest_m, 0.0};
  Pose2 high{-nearest_m, -nearest_m, 0.0};
  for (const CellIndex& cell : free_cells) {
    const Pose2 center = PoseGrid::center(cell);
    nearest_m = std::min(nearest_m, distance_m(center, start.map_from_robot));
    low = {std::min(low.x_m, center.x_m), std::min(low.y_m, center.y_m), 0.0};
    high = {std::max(high.x_m, center.x_m), std::max(high.y_m, center.y_m), 0.0};
  }
  if (nearest_m <= reach_m) return {};
  if (free_cells.empty()) return no_start("the map has no free space to start in");
  return no_start(
      fmt::format("no free space within {:.2f} m of ({:g}, {:g}); the map's reaches from "
                  "x {:.1f} to {:.1f} m and y {:.1f} to {:.1f} m",
                  reach_m,
                  start.map_from_robot.x_m,
                  start.map_from_robot.y_m,
                  low.x_m,
                  high.x_m,
                  low.y_m,
                  high.y_m));
}

}  // namespace

Result<KnownStart> known_start(const std::string& init) {
  SEMVIEW_TRY(const std::vector<double> numbers, parse_numbers("--init", init, 4));
  if (!PoseGrid::cell(numbers[0], numbers[1])) {
    return no_start(fmt::format(
        "X {} or Y {} is beyond {} m", numbers[0], numbers[1], PoseGrid::kMaxCoordinate_m));
  }
  if (!(numbers[3] >= 0.0 && numbers[3] <= kMostSigma_m)) {
    return no_start(fmt::format(
        "SIGMA {} is not in 0..{} m; --global starts anywhere", numbers[3], kMostSigma_m));
  }
  return KnownStart{{numbers[0], numbers[1], wrap_angle(rad_from_deg(numbers[2]))}, numbers[3]};
}

Result<localization::ParticleSet> first_particles(const LocalizeOptions& options,
                                                  std::span<const CellIndex> free_cells) {
  const std::size_t count = particles_of(options);
  Rng rng(options.seed, "initialization");
  if (!options.global.empty()) {
    if (free_cells.empty()) {
      return fail(ErrorCode::kFailedPrecondition,
                  fmt::format("{}: --global needs free space, and the map has none", options.map));
    }
    localization::ParticleSet particles = localization::uniform_particles(free_cells, count, rng);
    // A single depth image is no compass: each particle keeps the heading it was thrown in with.
    if (heading_of(options) == "odometry") {
      for (localization::Particle& one : particles) one.yaw_known = true;
    }
    return particles;
  }
  SEMVIEW_TRY(const KnownStart start, known_start(options.init));
  SEMVIEW_TRY_STATUS(check_reaches(start, free_cells));
  return localization::gaussian_particles(start.map_from_robot,
                                          start.sigma_m,
                                          rad_from_deg(options.init_heading_sigma_deg),
                                          count,
                                          rng);
}

}  // namespace semview::cli
