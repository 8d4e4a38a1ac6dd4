// SPDX-License-Identifier: Apache-2.0
#include "view_request.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

#include "semview/geometry/pinhole_camera.hpp"
#include "semview/protocol/envelope.hpp"
#include "semview/protocol/map_wire.hpp"
#include "semview/protocol/view_wire.hpp"
#include "semview/view/view_profile.hpp"

namespace semview::server {
namespace {

/// @errors kInvalidArgument, kResourceExhausted: what was asked cannot be sent.
Result<ViewEncoding> encoding_of(const v1::GetViewsRequest& wire, const ViewProfile& profile) {
  const bool grid = wire.has_cells() || wire.has_poses();
  if (wire.encoding() < v1::VIEW_ENCODING_UNSPECIFIED ||
      wire.encoding() > v1::VIEW_ENCODING_PIXELS) {
    return protocol::wrong_field(
        "encoding", fmt::format("{} is not an encoding", static_cast<int>(wire.encoding())));
  }
  if (grid && wire.with_ranges() && !profile.ranges) {
    return protocol::wrong_field("with_ranges",
                                 "this server's views of the grid have no ranges (--ranges)");
  }
  if (wire.has_pinholes() && wire.encoding() == v1::VIEW_ENCODING_RUNS) {
    return protocol::wrong_field("encoding", "a pinhole image comes as pixels only");
  }
  const bool runs = !wire.has_pinholes() && wire.encoding() != v1::VIEW_ENCODING_PIXELS;
  return ViewEncoding{runs, runs && wire.packed_runs(), wire.with_ranges()};
}

std::uint64_t pixels_of_one(const ViewRequest& request) {
  return static_cast<std::uint64_t>(request.rows) * static_cast<std::uint64_t>(request.columns);
}

/// Refuses an exact view that is too large by itself.
Status check_size(const ViewRequest& request,
                  const service::Limits& limits,
                  std::string_view field) {
  if (pixels_of_one(request) <= limits.max_pixels) return {};
  return fail(Error{ErrorCode::kResourceExhausted,
                    fmt::format("{}: {} × {} pixels; at most {} in one view",
                                field,
                                request.rows,
                                request.columns,
                                limits.max_pixels),
                    std::string(field)});
}

/// Refuses more pixels than one reply may hold. Runs are a tenth of the pixels and not counted
/// apart; a range counts as four label pixels, being four bytes.
Status check_pixels(const ViewRequest& request,
                    const service::Limits& limits,
                    std::string_view field) {
  const bool ranges = request.encoding.ranges;
  const std::uint64_t total = pixels_of_one(request) * request.views * (ranges ? 5 : 1);
  if (total <= limits.max_request_pixels) return {};
  return fail(Error{ErrorCode::kResourceExhausted,
                    fmt::format("{}: {} views of {} × {} pixels{}; at most {} in one request",
                                field,
                                request.views,
                                request.rows,
                                request.columns,
                                ranges ? " with ranges, which count as four" : "",
                                limits.max_request_pixels),
                    std::string(field),
                    "split the request"});
}

/// Distinct cells in the order of first use, and who wants them.
void merge_cells(const std::vector<CellIndex>& cells,
                 const std::vector<int>& headings,
                 ViewRequest* request) {
  std::unordered_map<CellIndex, std::size_t> place;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto [entry, added] = place.try_emplace(cells[i], request->cells.size());
    if (added) {
      request->cells.push_back(cells[i]);
      request->uses.emplace_back();
    }
    request->uses[entry->second].push_back({i, headings.empty() ? 0 : headings[i]});
  }
}

Status read_grid(const v1::GetViewsRequest& wire,
                 const service::Limits& limits,
                 ViewRequest* request) {
  std::vector<CellIndex> cells;
  std::vector<int> headings;
  if (wire.has_cells()) {
    SEMVIEW_TRY(cells, protocol::from_wire(wire.cells(), limits.max_views, "cells"));
  } else {
    SEMVIEW_TRY(const std::vector<Pose2> poses,
                protocol::from_wire(wire.poses(), limits.max_views, "poses"));
    for (const Pose2& pose : poses) {
      const auto key = PoseGrid::key(pose);
      if (!key) return protocol::wrong_field("poses", "a pose has no cell");
      cells.push_back(key->cell);
      headings.push_back(key->heading);
    }
  }
  request->rows = request->site->profile().camera.rows;
  request->columns = request->site->profile().camera.columns;
  request->views = cells.size();
  merge_cells(cells, headings, request);
  return check_pixels(*request, limits, wire.has_cells() ? "cells" : "poses");
}

Status read_panoramas(const v1::ExactPanoramas& wire,
                      const service::Limits& limits,
                      ViewRequest* request) {
  constexpr std::string_view kPoses = "panoramas.poses";
  SEMVIEW_TRY(const std::vector<Pose2> poses,
              protocol::from_wire(wire.poses(), limits.max_views, kPoses));
  ViewProfile profile = request->site->profile();
  if (wire.has_profile()) {
    SEMVIEW_TRY(profile, protocol::from_wire(wire.profile(), "panoramas.profile"));
  }
  SEMVIEW_TRY(const MapAffine affine, protocol::from_wire(wire.affine(), "panoramas.affine"));
  for (const Pose2& pose : poses) {
    request->panoramas.push_back(
        {pose, request->site->eye_z_m(profile.eye_height_m), profile.camera, affine});
  }
  request->rows = profile.camera.rows;
  request->columns = profile.camera.columns;
  request->views = poses.size();
  SEMVIEW_TRY_STATUS(check_size(*request, limits, "panoramas.profile.rows"));
  return check_pixels(*request, limits, kPoses);
}

/// 0 is that of the map's profile.
Result<double> eye_height_of(const v1::ExactPinholes& wire, ViewProfile profile) {
  if (wire.eye_height_m() == 0.0) return profile.eye_height_m;
  profile.eye_height_m = wire.eye_height_m();
  if (Status status = validate(profile); !status) {
    return protocol::wrong_field("pinholes.eye_height_m", status.error().message);
  }
  return profile.eye_height_m;
}

Status read_pinholes(const v1::ExactPinholes& wire,
                     const service::Limits& limits,
                     ViewRequest* request) {
  constexpr std::string_view kPoses = "pinholes.poses";
  SEMVIEW_TRY(const std::vector<Pose2> poses,
              protocol::from_wire(wire.poses(), limits.max_views, kPoses));
  SEMVIEW_TRY(const PinholeCamera camera, protocol::camera_from_wire(wire, "pinholes"));
  SEMVIEW_TRY(const double eye_height_m, eye_height_of(wire, request->site->profile()));
  for (const Pose2& pose : poses) {
    request->pinholes.push_back({level_camera(pose, request->site->eye_z_m(eye_height_m)), camera});
  }
  if (Status status = raycast::validate(request->pinholes.front()); !status) {
    return protocol::wrong_field(fmt::format("pinholes.{}", status.error().field),
                                 status.error().message);
  }
  request->rows = camera.rows;
  request->columns = camera.columns;
  request->views = poses.size();
  SEMVIEW_TRY_STATUS(check_size(*request, limits, "pinholes.rows"));
  return check_pixels(*request, limits, kPoses);
}

}  // namespace

Result<ViewRequest> read_view_request(std::shared_ptr<service::Site> site,
                                      const v1::GetViewsRequest& wire,
                                      const service::Limits& limits) {
  ViewRequest request;
  request.site = std::move(site);
  SEMVIEW_TRY(request.encoding, encoding_of(wire, request.site->profile()));
  switch (wire.target_case()) {
    case v1::GetViewsRequest::kCells:
    case v1::GetViewsRequest::kPoses:
      SEMVIEW_TRY_STATUS(read_grid(wire, limits, &request));
      break;
    case v1::GetViewsRequest::kPanoramas:
      SEMVIEW_TRY_STATUS(read_panoramas(wire.panoramas(), limits, &request));
      break;
    case v1::GetViewsRequest::kPinholes:
      SEMVIEW_TRY_STATUS(read_pinholes(wire.pinholes(), limits, &request));
      break;
    case v1::GetViewsRequest::TARGET_NOT_SET:
      return protocol::wrong_field("target", "expected cells, poses, panoramas or pinholes");
  }
  return request;
}

}  // namespace semview::server
