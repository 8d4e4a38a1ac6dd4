// SPDX-License-Identifier: Apache-2.0
#include "foreign_estimates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "semview/evaluation/poses_at.hpp"
#include "semview/geometry/angle.hpp"
#include "world_export.hpp"

namespace semview::paper2017 {
namespace {

namespace fs = std::filesystem;

/// The files of a row and world: one, or one a run.
std::vector<fs::path> track_files(const fs::path& only) {
  if (fs::exists(only)) return {only};
  std::vector<fs::path> files;
  for (int run = 1;; ++run) {
    fs::path file = only;
    file.replace_extension(fmt::format(".run_{}.tum", run));
    if (!fs::exists(file)) return files;
    files.push_back(std::move(file));
  }
}

}  // namespace

Status check_foreign_name(const std::string& name) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  if (!name.empty() && std::ranges::all_of(name, plain) && name != "odometry" &&
      find_method(name) == nullptr) {
    return {};
  }
  return fail(Error{ErrorCode::kInvalidArgument,
                    fmt::format("--estimates {}: expected a name of letters, digits, _ and - that "
                                "no method here has",
                                name),
                    "--estimates"});
}

std::vector<StopRecord> errors_of(const std::vector<Pose2>& poses,
                                  const std::vector<Pose2>& truth,
                                  const std::vector<Pose2>& odometry) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  const Pose2 map_from_odom = truth.front() * inverse(odometry.front());
  std::vector<StopRecord> stops;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    StopRecord stop;
    stop.stop = static_cast<int>(i) + 1;
    stop.best_m = stop.estimate_m = distance_m(poses[i], truth[i]);
    // Its particles, if it has any, are its own affair.
    stop.weighted_mean_m = stop.mean_m = stop.min_m = kNothing;
    stop.heading_rad = std::abs(wrap_angle(poses[i].yaw_rad - truth[i].yaw_rad));
    stop.odometry_m = distance_m(map_from_odom * odometry[i], truth[i]);
    stops.push_back(stop);
  }
  return stops;
}

Result<ForeignMethod> read_estimates(const ForeignEstimates& estimates,
                                     const ExperimentConfig& config) {
  SEMVIEW_TRY_STATUS(check_foreign_name(estimates.name));
  SEMVIEW_TRY(const std::vector<Row> rows, rows_of(config));
  const std::vector<double> stamps_s = stop_stamps_s();
  ForeignMethod method{estimates.name, {}};
  for (const Row& row : rows) {
    for (const std::uint64_t world : config.worlds) {
      const fs::path only = estimates.directory / track_file(row.id, world);
      const std::vector<fs::path> files = track_files(only);
      if (files.empty()) {
        return fail(ErrorCode::kNotFound,
                    fmt::format("{}: is missing; expected one for each of {} rows and {} worlds",
                                only.string(),
                                rows.size(),
                                config.worlds.size()));
      }
      for (std::size_t run = 0; run < files.size(); ++run) {
        ForeignDrive drive{row.id, world, run + 1, {}};
        SEMVIEW_TRY(drive.poses, evaluation::read_poses_at(files[run], stamps_s));
        method.drives.push_back(std::move(drive));
      }
    }
  }
  return method;
}

void add_drives(const ForeignMethod& method, Experiment& experiment) {
  const std::vector<std::uint64_t>& seeds = experiment.config.worlds;
  for (const ForeignDrive& drive : method.drives) {
    const auto found = std::ranges::find(seeds, drive.world) - seeds.begin();
    const World& world = experiment.worlds[static_cast<std::size_t>(found)];
    std::vector<Pose2> odometry;
    for (const Stop& stop : world.stops) odometry.push_back(stop.odom_from_robot);
    experiment.trials.push_back(
        {drive.row,
         method.name,
         experiment.config.starts.front(),
         drive.world,
         drive.run,
         errors_of(drive.poses, true_poses(world, *find_row(drive.row)), odometry)});
  }
}

}  // namespace semview::paper2017
