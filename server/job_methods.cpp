// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <utility>

#include "methods.hpp"
#include "semview/cache/view_cache.hpp"
#include "semview/protocol/envelope.hpp"
#include "semview/protocol/map_wire.hpp"
#include "semview/service/precompute.hpp"
#include "semview/v1/jobs.pb.h"

namespace semview::server {
namespace {

protocol::JobState state_of(service::JobState state) {
  switch (state) {
    case service::JobState::kQueued:
      return protocol::JobState::kQueued;
    case service::JobState::kRunning:
      return protocol::JobState::kRunning;
    case service::JobState::kDone:
      return protocol::JobState::kDone;
    case service::JobState::kFailed:
      return protocol::JobState::kFailed;
    case service::JobState::kCancelled:
      return protocol::JobState::kCancelled;
  }
  return protocol::JobState::kFailed;
}

/// The service names options of the command line: here they are fields of the request.
tl::unexpected<Error> in_request(Error error) {
  if (error.field == "--region") error.field = "region";
  if (error.field == "--reachable-from") error.field = "reachable_from";
  return fail(std::move(error));
}

Result<service::PrecomputeRegion> region_of(const v1::StartPrecomputeRequest& wire) {
  service::PrecomputeRegion region;
  const auto finite = [](const auto& numbers) {
    for (const double number : numbers) {
      if (!std::isfinite(number)) return false;
    }
    return true;
  };
  if (wire.has_region() && wire.has_reachable_from()) {
    return protocol::wrong_field("reachable_from", "not together with region");
  }
  if (wire.has_region()) {
    const v1::Region& box = wire.region();
    region.rectangle_m = std::array{box.x_min_m(), box.y_min_m(), box.x_max_m(), box.y_max_m()};
    if (!finite(*region.rectangle_m)) {
      return protocol::wrong_field("region", "expected finite numbers");
    }
  }
  if (wire.has_reachable_from()) {
    region.reachable_from_m = std::array{wire.reachable_from().x_m(), wire.reachable_from().y_m()};
    if (!finite(*region.reachable_from_m)) {
      return protocol::wrong_field("reachable_from", "expected finite numbers");
    }
  }
  return region;
}

void to_wire(const cache::StoreCounters& counters, v1::CacheTier* wire) {
  wire->set_hits(counters.hits);
  wire->set_misses(counters.misses);
  wire->set_stored(counters.stored);
  wire->set_evicted(counters.evicted);
  wire->set_refused(counters.refused);
  wire->set_damaged(counters.damaged);
  wire->set_foreign(counters.foreign);
  wire->set_unknown(counters.unknown);
  wire->set_bytes(counters.bytes);
  wire->set_storing(counters.storing);
}

}  // namespace

protocol::JobProgress progress_of(const Services& services, const service::JobStatus& status) {
  protocol::JobProgress progress;
  progress.job_id = wire_id(services, status.id);
  progress.map_id = status.map_id;
  progress.state = state_of(status.state);
  progress.total_cells = status.progress.cells;
  progress.found_cells = status.progress.found;
  progress.cast_cells = status.progress.cast;
  progress.elapsed_s = status.progress.elapsed_s;
  progress.remaining_s = status.progress.remaining_s;
  if (status.state == service::JobState::kFailed) progress.error = status.error;
  return progress;
}

Result<Plan> plan_start_precompute(Services& services, const Request& request) {
  SEMVIEW_TRY(const auto wire, protocol::parse<v1::StartPrecomputeRequest>(request.body, "body"));
  SEMVIEW_TRY(std::shared_ptr<service::Site> site,
              find_site(services, wire.map_id(), wire.fingerprint()));
  SEMVIEW_TRY(const service::PrecomputeRegion region, region_of(wire));
  Result<std::uint64_t> id = services.jobs.start_precompute(std::move(site), region);
  if (!id) return in_request(std::move(id).error());
  services.job_was_started();
  v1::StartPrecomputeReply reply;
  reply.set_job_id(wire_id(services, *id));
  return answer(reply.SerializeAsString());
}

Result<Plan> plan_job_status(Services& services, const Request& request) {
  SEMVIEW_TRY(const auto wire, protocol::parse<v1::JobStatusRequest>(request.body, "body"));
  SEMVIEW_TRY(const std::uint64_t number, number_of(services, wire.job_id(), "job_id"));
  SEMVIEW_TRY(const service::JobStatus status, services.jobs.status(number));
  return answer(protocol::to_wire(progress_of(services, status)).SerializeAsString());
}

Result<Plan> plan_cancel_job(Services& services, const Request& request) {
  SEMVIEW_TRY(const auto wire, protocol::parse<v1::CancelJobRequest>(request.body, "body"));
  SEMVIEW_TRY(const std::uint64_t number, number_of(services, wire.job_id(), "job_id"));
  SEMVIEW_TRY_STATUS(services.jobs.cancel(number));
  return answer(v1::CancelJobReply().SerializeAsString());
}

Result<Plan> plan_get_stats(Services& services, const Request& request) {
  SEMVIEW_TRY([[maybe_unused]] const auto wire,
              protocol::parse<v1::GetStatsRequest>(request.body, "body"));
  const ServerCounters counters = services.counters();
  v1::GetStatsReply reply;
  reply.set_uptime_s(counters.uptime_s);
  reply.set_requests(counters.requests);
  reply.set_errors(counters.errors);
  reply.set_refused(counters.refused);
  reply.set_expired(counters.expired);
  reply.set_malformed(counters.malformed);
  reply.set_undelivered(counters.undelivered);
  reply.set_in_flight_requests(counters.in_flight);
  reply.set_queued_cells(counters.queued_cells);
  for (const auto& [client, cells] : counters.cells_by_client) {
    (*reply.mutable_cells_by_client())[client] = cells;
  }
  for (const auto& [method, latency] : counters.latency_by_method) {
    v1::MethodLatency& wire_latency = (*reply.mutable_latency_by_method())[method];
    wire_latency.set_count(latency.count);
    wire_latency.set_p50_ms(latency.p50_ms);
    wire_latency.set_p95_ms(latency.p95_ms);
    wire_latency.set_p99_ms(latency.p99_ms);
    wire_latency.set_max_ms(latency.max_ms);
  }
  if (const auto sites = services.maps.sites(); !sites.empty()) {
    // All sites share one cache.
    const service::SharedTiers& tiers = sites.front()->tiers();
    const cache::ViewCacheCounters views = tiers.cache->counters();
    reply.set_views_cast(views.cast);
    reply.set_views_from_memory(views.memory.hits);
    reply.set_views_from_disk(views.disk.hits);
    reply.set_views_awaited(views.waits);
    to_wire(views.memory, reply.mutable_memory());
    if (tiers.store != nullptr) to_wire(views.disk, reply.mutable_disk());
  }
  reply.set_observations(services.observations.counters().observations);
  return answer(reply.SerializeAsString());
}

}  // namespace semview::server
