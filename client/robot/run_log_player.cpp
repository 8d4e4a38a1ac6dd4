// SPDX-License-Identifier: Apache-2.0
#include "client/robot/run_log_player.hpp"

#include <utility>

#include <fmt/format.h>

#include "semview/io/trajectory.hpp"

namespace semview::robot {

Result<Drive> play(const io::RunLog& log,
                   const PanoramaCamera& camera,
                   Localizer& localizer,
                   const PlayerHooks& hooks) {
  Drive drive;
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    Frame frame;
    frame.stamp_s = log.frames[i].stamp_s;
    const Result<Pose2> odometry = io::interpolate(log.odometry, frame.stamp_s);
    if (!odometry) {
      ++drive.frames_without_odometry;
      continue;
    }
    frame.odom_from_robot = *odometry;
    if (hooks.wait_until) hooks.wait_until(frame.stamp_s);
    if (hooks.stopped && hooks.stopped()) {
      return fail(ErrorCode::kCancelled,
                  fmt::format("stopped before frame {} of {}", i + 1, log.frames.size()));
    }
    if (hooks.observe) {
      SEMVIEW_TRY(frame.observation, hooks.observe(i));
    } else if (!log.frames[i].labels.empty()) {
      SEMVIEW_TRY(frame.observation, io::read_frame(log, i, camera));
    }
    Result<FrameReport> report = localizer.advance(frame);
    if (!report) {
      return with_context(std::move(report),
                          fmt::format("frame {} of {}", i + 1, log.frames.size()));
    }
    if (hooks.on_frame) hooks.on_frame(*report, i + 1, log.frames.size());
    drive.frames.push_back(*std::move(report));
  }
  if (drive.frames.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: none of the {} frames lies in the time that odometry.txt covers",
                            log.directory.string(),
                            log.frames.size()));
  }
  return drive;
}

}  // namespace semview::robot
