// SPDX-License-Identifier: Apache-2.0
#include <optional>
#include <utility>

#include "methods.hpp"
#include "semview/core/version.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/map/gltf_write.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/protocol/envelope.hpp"
#include "semview/protocol/map_wire.hpp"
#include "semview/service/shipped_weights.hpp"
#include "semview/v1/maps.pb.h"

namespace semview::server {
namespace {

protocol::MapSummary summary_of(const service::Site& site) {
  return {site.id(), site.map().name, site.map().fingerprint};
}

protocol::MapDescription describe(const service::Site& site) {
  protocol::MapDescription map;
  map.summary = summary_of(site);
  map.classes = site.map().classes;
  for (const map::MapClass& entry : site.map().class_details) map.colors.push_back(entry.color);
  map.ground_height_m = site.map().ground_height_m;
  map.profile = site.profile();
  map.engine = site.engine().name;
  map.engine_version = site.engine().version;
  map.engine_reason = site.engine().reason;
  map.free_cells = site.cells().free_cells();
  return map;
}

Result<std::string> glb_of(const map::SemanticMap& map) {
  if (const map::MeshGeometry* const mesh = map.mesh()) return map::encode_glb(map, mesh->mesh);
  return map::encode_glb(map, map::extrude(*map.columns()));
}

}  // namespace

Result<Plan> plan_hello(Services& services, const Request& request) {
  SEMVIEW_TRY([[maybe_unused]] const auto wire,
              protocol::parse<v1::HelloRequest>(request.body, "body"));
  v1::HelloReply reply;
  reply.set_server_version(kVersion);
  reply.set_protocol_version(protocol::kProtocolVersion);
  reply.set_events_port(services.events_port);
  for (const std::string_view name : method_names()) reply.add_methods(std::string(name));
  v1::Limits* const limits = reply.mutable_limits();
  limits->set_message_bytes(services.limits.max_message_bytes);
  limits->set_poses(static_cast<std::uint32_t>(services.limits.max_poses));
  limits->set_curve_poses(static_cast<std::uint32_t>(services.limits.max_curve_poses));
  limits->set_distorted_poses(static_cast<std::uint32_t>(services.limits.max_distorted_poses));
  limits->set_views(static_cast<std::uint32_t>(services.limits.max_views));
  limits->set_view_pixels(services.limits.max_pixels);
  limits->set_request_pixels(services.limits.max_request_pixels);
  limits->set_heat_map_cells(static_cast<std::uint32_t>(services.limits.max_heat_map_cells));
  limits->set_in_flight_requests(
      static_cast<std::uint32_t>(services.limits.max_in_flight_per_client));
  limits->set_queued_cells(services.limits.max_queued_cells);
  limits->set_default_deadline_ms(services.default_deadline_ms);
  limits->set_max_deadline_ms(services.max_deadline_ms);
  return answer(reply.SerializeAsString());
}

Result<Plan> plan_list_maps(Services& services, const Request& request) {
  SEMVIEW_TRY([[maybe_unused]] const auto wire,
              protocol::parse<v1::ListMapsRequest>(request.body, "body"));
  v1::ListMapsReply reply;
  for (const auto& site : services.maps.sites()) {
    *reply.add_maps() = protocol::to_wire(summary_of(*site));
  }
  return answer(reply.SerializeAsString());
}

Result<Plan> plan_get_map(Services& services, const Request& request) {
  SEMVIEW_TRY(const auto wire, protocol::parse<v1::GetMapRequest>(request.body, "body"));
  SEMVIEW_TRY(const std::shared_ptr<service::Site> site, find_site(services, wire.map_id(), {}));
  protocol::MapDescription map = describe(*site);
  SEMVIEW_TRY(map.weights_csv, service::shipped_weights_csv(site->map().directory));
  if (wire.with_glb()) {
    SEMVIEW_TRY(map.glb, glb_of(site->map()));
  }
  return answer(protocol::to_wire(map).SerializeAsString());
}

}  // namespace semview::server
