// SPDX-License-Identifier: Apache-2.0
/// The particles that `semview localize` leaves behind, for drawing.
#pragma once

#include <filesystem>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/pose2.hpp"

namespace semview::evaluation {

/// Reads the poses of a CSV whose first columns are `x_m,y_m,yaw_deg`.
/// @errors kNotFound: cannot be read; kInvalidArgument with file and line.
Result<std::vector<Pose2>> read_particles(const std::filesystem::path& path);

}  // namespace semview::evaluation
