// SPDX-License-Identifier: Apache-2.0
/// Views that a server casts at the exact pose instead of the grid.
#pragma once

#include <string>

#include "client/lib/connection.hpp"
#include "semview/geometry/affine.hpp"
#include "semview/geometry/pinhole_camera.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/view/column_view.hpp"
#include "semview/view/view_profile.hpp"

namespace semview::client {

struct ExactView {
  LabelImage labels;
  RangeImage distances_m;  ///< ranges of a panorama, depths of a pinhole image
};

/// The panorama of `profile`'s camera and eye height, which may differ from the server's own.
/// @errors kNotFound: no such map; kInvalidArgument, kResourceExhausted: a pose, camera or affine
/// that the server refuses, the field named; those of `Connection::call`; kDataLoss: no such view.
Result<ExactView> exact_panorama(Connection& connection,
                                 const std::string& map_id,
                                 const Pose2& map_from_robot,
                                 const ViewProfile& profile,
                                 const MapAffine& affine = {});

/// What a level pinhole camera sees, looking along the pose's yaw. @errors as above
Result<ExactView> exact_pinhole(Connection& connection,
                                const std::string& map_id,
                                const Pose2& map_from_robot,
                                double eye_height_m,
                                const PinholeCamera& camera);

}  // namespace semview::client
