// SPDX-License-Identifier: Apache-2.0
/// Plays a recorded drive to a localizer.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "client/robot/localizer.hpp"
#include "semview/core/result.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/io/run_log.hpp"

namespace semview::robot {

/// What a player tells while it plays. Members may be empty.
struct PlayerHooks {
  /// Called before the frame of this stamp is played, to keep the log's pace; a robot's clock.
  std::function<void(double stamp_s)> wait_until = {};
  /// Makes the observation of the frame of this index, in place of reading the log's labels; none
  /// where the camera gave nothing.
  std::function<Result<std::optional<Observation>>(std::size_t index)> observe = {};
  /// Asked before each frame; true ends the run with kCancelled.
  std::function<bool()> stopped = {};
  /// Called after each frame; `done` of `total` frames.
  std::function<void(const FrameReport& report, std::size_t done, std::size_t total)> on_frame = {};
};

struct Drive {
  std::vector<FrameReport> frames;
  std::size_t frames_without_odometry = 0;
};

/// Plays every frame in order: odometry interpolated at the frame's stamp, labels resampled to
/// `camera`. Frames outside the time that odometry covers are left out and counted; a frame without
/// labels is played without an observation.
/// @errors kInvalidArgument: no frame has odometry; those of `io::read_frame` and
/// `Localizer::advance`, with the frame's number; kCancelled: `hooks.stopped`. What was
/// reported to `hooks.on_frame` before it is the caller's to keep.
Result<Drive> play(const io::RunLog& log,
                   const PanoramaCamera& camera,
                   Localizer& localizer,
                   const PlayerHooks& hooks = {});

}  // namespace semview::robot
