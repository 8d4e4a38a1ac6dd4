// SPDX-License-Identifier: Apache-2.0
#include "client/lib/remote_maps.hpp"

#include "client/lib/typed_call.hpp"
#include "semview/protocol/map_wire.hpp"

namespace semview::client {

Result<std::vector<protocol::MapSummary>> list_maps(Connection& connection) {
  SEMVIEW_TRY(const auto reply,
              typed_call<v1::ListMapsReply>(connection, "ListMaps", v1::ListMapsRequest()));
  std::vector<protocol::MapSummary> maps;
  for (const v1::MapSummary& wire : reply.maps()) {
    SEMVIEW_TRY(protocol::MapSummary summary, protocol::from_wire(wire));
    maps.push_back(std::move(summary));
  }
  return maps;
}

Result<protocol::MapDescription> get_map(Connection& connection,
                                         const std::string& map_id,
                                         bool with_glb) {
  v1::GetMapRequest request;
  request.set_map_id(map_id);
  request.set_with_glb(with_glb);
  SEMVIEW_TRY(const auto reply, typed_call<v1::GetMapReply>(connection, "GetMap", request));
  return protocol::from_wire(reply);
}

void to_wire(const Region& region, v1::Region* wire) {
  wire->set_x_min_m(region.x_min_m);
  wire->set_y_min_m(region.y_min_m);
  wire->set_x_max_m(region.x_max_m);
  wire->set_y_max_m(region.y_max_m);
}

Result<std::string> start_precompute(Connection& connection, const PrecomputeRequest& request) {
  v1::StartPrecomputeRequest wire;
  wire.set_map_id(request.map_id);
  if (request.region) to_wire(*request.region, wire.mutable_region());
  if (request.reachable_from) {
    wire.mutable_reachable_from()->set_x_m(request.reachable_from->x_m);
    wire.mutable_reachable_from()->set_y_m(request.reachable_from->y_m);
  }
  // A second one would be a second job.
  SEMVIEW_TRY(
      const auto reply,
      typed_call<v1::StartPrecomputeReply>(connection, "StartPrecompute", wire, Repeat::kNever));
  return reply.job_id();
}

Result<protocol::JobProgress> job_status(Connection& connection, const std::string& job_id) {
  v1::JobStatusRequest request;
  request.set_job_id(job_id);
  SEMVIEW_TRY(const auto reply, typed_call<v1::JobStatusReply>(connection, "JobStatus", request));
  return protocol::from_wire(reply);
}

Status cancel_job(Connection& connection, const std::string& job_id) {
  v1::CancelJobRequest request;
  request.set_job_id(job_id);
  SEMVIEW_TRY([[maybe_unused]] const auto reply,
              typed_call<v1::CancelJobReply>(connection, "CancelJob", request));
  return {};
}

}  // namespace semview::client
