// SPDX-License-Identifier: Apache-2.0
#include "client/lib/remote_exact_view.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

#include <fmt/format.h>

#include "client/lib/typed_call.hpp"
#include "semview/protocol/map_wire.hpp"
#include "semview/protocol/view_wire.hpp"

namespace semview::client {
namespace {

Result<ExactView> ask(Connection& connection, v1::GetViewsRequest& request) {
  request.set_encoding(v1::VIEW_ENCODING_PIXELS);
  request.set_with_ranges(true);
  SEMVIEW_TRY(const auto reply, typed_call<v1::GetViewsReply>(connection, "GetViews", request));
  const std::uint64_t pixels = std::uint64_t{reply.rows()} * reply.columns();
  if (reply.views_size() != 1 ||
      static_cast<std::uint64_t>(reply.views(0).ranges_m_size()) != pixels) {
    return fail(ErrorCode::kDataLoss,
                fmt::format("{} views of {} × {} pixels; expected one, with its ranges",
                            reply.views_size(),
                            reply.rows(),
                            reply.columns()));
  }
  const v1::View& wire = reply.views(0);
  ExactView view;
  SEMVIEW_TRY(view.labels,
              protocol::labels_from_bytes(wire.labels(), reply.rows(), reply.columns(), "labels"));
  view.distances_m = RangeImage(view.labels.rows(), view.labels.columns());
  std::ranges::copy(wire.ranges_m(), view.distances_m.pixels().begin());
  return view;
}

}  // namespace

Result<ExactView> exact_panorama(Connection& connection,
                                 const std::string& map_id,
                                 const Pose2& map_from_robot,
                                 const ViewProfile& profile,
                                 const MapAffine& affine) {
  v1::GetViewsRequest request;
  request.set_map_id(map_id);
  v1::ExactPanoramas* const exact = request.mutable_panoramas();
  protocol::to_wire(std::span(&map_from_robot, 1), exact->mutable_poses());
  *exact->mutable_profile() = protocol::to_wire(profile);
  exact->mutable_affine()->set_a(affine.a);
  exact->mutable_affine()->set_b(affine.b);
  exact->mutable_affine()->set_k(affine.k);
  return ask(connection, request);
}

Result<ExactView> exact_pinhole(Connection& connection,
                                const std::string& map_id,
                                const Pose2& map_from_robot,
                                double eye_height_m,
                                const PinholeCamera& camera) {
  v1::GetViewsRequest request;
  request.set_map_id(map_id);
  v1::ExactPinholes* const exact = request.mutable_pinholes();
  protocol::to_wire(std::span(&map_from_robot, 1), exact->mutable_poses());
  exact->set_columns(static_cast<std::uint32_t>(camera.columns));
  exact->set_rows(static_cast<std::uint32_t>(camera.rows));
  exact->set_fx_px(camera.fx_px);
  exact->set_fy_px(camera.fy_px);
  exact->set_cx_px(camera.cx_px);
  exact->set_cy_px(camera.cy_px);
  exact->set_eye_height_m(eye_height_m);
  return ask(connection, request);
}

}  // namespace semview::client
