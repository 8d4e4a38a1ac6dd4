// SPDX-License-Identifier: Apache-2.0
/// `--obs` and `--frame`: what a verb compares with the map.
#pragma once

#include <optional>
#include <string>

#include "semview/core/result.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/io/run_log.hpp"
#include "semview/view/observation.hpp"

namespace CLI {
class App;
}

namespace semview::cli {

struct ObservationOption {
  std::string folder;                ///< an observation folder, or a run log
  std::optional<std::size_t> frame;  ///< of the run log, from 0
};

void add_observation_option(CLI::App& verb, ObservationOption& option);

/// The observer's vocabulary.
/// @errors as `read`.
Result<ClassTable> read_observed_classes(const ObservationOption& option);

/// The run log whose frame is meant.
/// @errors those of reading it; kInvalidArgument: --frame is not given, or past its end; an
/// observation folder.
Result<io::RunLog> read_log_of(const ObservationOption& option);

/// Where the robot truly was at a frame of `log`, if that is known.
std::optional<Pose2> true_pose(const io::RunLog& log, std::size_t frame);

/// The observation, resampled to `profile`.
/// @errors those of the readers; kInvalidArgument: a run log without --frame, or past its end.
Result<Observation> read(const ObservationOption& option, const PanoramaCamera& profile);

}  // namespace semview::cli
