// SPDX-License-Identifier: Apache-2.0
/// The experiment's worlds as files for other people's programs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiment.hpp"
#include "semview/core/result.hpp"
#include "semview/geometry/pose2.hpp"
#include "world.hpp"

namespace semview::paper2017 {

/// Image i, from 0, of an exported log was taken at i + 1 seconds.
std::vector<double> stop_stamps_s();

/// Where a trajectory of a row and world lies below a folder: "ROW/world_W.tum".
std::filesystem::path track_file(const std::string& row, std::uint64_t world);

/// Where the robot is at each stop on the row's map.
std::vector<Pose2> true_poses(const World& world, const Row& row);

/// Writes for each row and world of `config`
///
///     input/ROW/world_W/{map,map_stacked,log,start.tum}
///     truth/ROW/world_W.tum
///
/// and `input/list.csv`, a line for each of them. `input` holds all that a method is given: the
/// row's distorted map as printed and with stacked profiles, both with the hand-made weights, the
/// camera's labels cut to the row's field of view, odometry, and the pose at the first image. All
/// filter seeds of the experiment drive the same recording, so that there is one log for all runs.
/// Training worlds may be exported too, for methods that learn.
/// @param progress  called with how many of how many are written
/// @errors as `validate` where it looks at rows and worlds; kAlreadyExists: `directory` holds an
/// export; those of maps and of writing.
Status export_worlds(const ExperimentConfig& config,
                     const std::filesystem::path& directory,
                     const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace semview::paper2017
