// SPDX-License-Identifier: Apache-2.0
/// What a localized drive leaves behind. The columns are described in docs/localization.md.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "client/robot/localizer.hpp"
#include "semview/core/result.hpp"
#include "semview/io/trajectory.hpp"

namespace semview::robot {

/// The pose of each frame.
std::vector<io::StampedPose2> trajectory(std::span<const FrameReport> frames);

/// One line a frame: state, pose, spread, N_eff, similarities, where the views came from.
std::string frames_csv(std::span<const FrameReport> frames);

/// One line a particle: x_m, y_m, yaw_deg (the reported heading), weight.
std::string particles_csv(const localization::ParticleSet& particles);

}  // namespace semview::robot
