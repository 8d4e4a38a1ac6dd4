// SPDX-License-Identifier: Apache-2.0
#include "semview/view/view_profile.hpp"

#include <cmath>

#include <fmt/format.h>

#include "semview/geometry/pose_grid.hpp"

namespace semview {
namespace {

tl::unexpected<Error> wrong(std::string field, std::string message) {
  return fail(Error{ErrorCode::kInvalidArgument, std::move(message), std::move(field)});
}

}  // namespace

Status validate(const ViewProfile& profile) {
  const PanoramaCamera& camera = profile.camera;
  if (camera.columns <= 0 || camera.columns > kMaxPanoramaColumns ||
      camera.columns % PoseGrid::kHeadings != 0) {
    return wrong("columns",
                 fmt::format("columns {} must be a multiple of {} up to {}",
                             camera.columns,
                             PoseGrid::kHeadings,
                             kMaxPanoramaColumns));
  }
  if (camera.rows <= 0 || camera.rows > kMaxPanoramaRows) {
    return wrong("rows", fmt::format("rows {} must be 1 to {}", camera.rows, kMaxPanoramaRows));
  }
  const double limit = kPi / 2.0;
  if (!(camera.elevation_min_rad >= -limit && camera.elevation_max_rad <= limit &&
        camera.elevation_min_rad < camera.elevation_max_rad)) {
    return wrong("elevation",
                 fmt::format("elevation {:g} to {:g} degrees must increase within -90 to 90",
                             deg_from_rad(camera.elevation_min_rad),
                             deg_from_rad(camera.elevation_max_rad)));
  }
  if (!(profile.eye_height_m > 0.0 && profile.eye_height_m <= 100.0)) {
    return wrong(
        "eye_height_m",
        fmt::format("eye height {:g} m must be above 0 and at most 100", profile.eye_height_m));
  }
  return {};
}

}  // namespace semview
