// SPDX-License-Identifier: Apache-2.0
/// The methods of docs/protocol.md: from a request's body to a plan.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "dispatcher.hpp"
#include "plan.hpp"
#include "semview/core/hash.hpp"
#include "semview/core/latency_histogram.hpp"
#include "semview/core/result.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/protocol/descriptions.hpp"
#include "semview/service/jobs.hpp"
#include "semview/service/limits.hpp"
#include "semview/service/map_registry.hpp"
#include "semview/service/observation_store.hpp"
#include "semview/service/site.hpp"
#include "semview/service/weight_matrices.hpp"

namespace semview::v1 {
class ScoreRequest;
}

namespace semview::server {

/// What a client is told to wait before it tries an overloaded server again.
inline constexpr std::uint32_t kRetryAfter_ms = 200;

/// What the server counts by itself; the rest comes from the service.
struct ServerCounters {
  double uptime_s = 0.0;
  std::uint64_t requests = 0;
  std::uint64_t errors = 0;
  std::uint64_t refused = 0;
  std::uint64_t expired = 0;
  std::uint64_t malformed = 0;
  std::uint64_t undelivered = 0;
  std::uint64_t in_flight = 0;
  std::uint64_t queued_cells = 0;
  std::map<std::string, std::uint64_t> cells_by_client;
  std::map<std::string, LatencySummary> latency_by_method;
};

/// Everything that methods work on. @threads used by all workers at once
struct Services {
  Services(service::MapRegistry registry, service::Limits the_limits, std::uint64_t the_epoch)
      : maps(std::move(registry)),
        limits(the_limits),
        epoch(the_epoch),
        observations(the_limits),
        jobs(the_limits) {}

  const service::MapRegistry maps;
  const service::Limits limits;
  const std::uint64_t epoch;
  service::ObservationStore observations;
  service::WeightMatrices weights;
  service::Jobs jobs;
  std::uint32_t default_deadline_ms = 0;
  std::uint32_t max_deadline_ms = 0;
  std::uint16_t events_port = 0;
  std::function<ServerCounters()> counters;
  std::function<std::uint64_t()> queued_cells;
  /// `check_wait` for a request that has turned out to be of so many cells.
  std::function<Status(const Request&, std::uint64_t cells)> check_wait;
  std::function<void()> job_was_started;
  /// Chunks already run side by side, so each scores in the worker's own thread.
  ThreadPool inline_pool{1};
};

/// The methods' names, in order.
std::span<const std::string_view> method_names();

/// What planning is reckoned to cost, before the body was looked at; 0: no such method.
std::uint64_t planning_cells(std::string_view method);

/// @errors what the method's body deserves; kUnimplemented: no such method.
Result<Plan> plan_request(Services& services, const Request& request);

// One file a group of methods.
Result<Plan> plan_hello(Services& services, const Request& request);
Result<Plan> plan_list_maps(Services& services, const Request& request);
Result<Plan> plan_get_map(Services& services, const Request& request);
Result<Plan> plan_get_views(Services& services, const Request& request);
Result<Plan> plan_set_observation(Services& services, const Request& request);
Result<Plan> plan_score(Services& services, const Request& request);
Result<Plan> plan_heatmap(Services& services, const Request& request);
Result<Plan> plan_start_precompute(Services& services, const Request& request);
Result<Plan> plan_job_status(Services& services, const Request& request);
Result<Plan> plan_cancel_job(Services& services, const Request& request);
Result<Plan> plan_get_stats(Services& services, const Request& request);

/// The site of a request, its fingerprint checked unless it is empty.
/// @errors kNotFound, field `map_id`; kFailedPrecondition, field `fingerprint`.
Result<std::shared_ptr<service::Site>> find_site(const Services& services,
                                                 const std::string& map_id,
                                                 const std::string& fingerprint);

/// Ids on the wire carry the server's epoch: `<epoch>-<number>`, so that one of an earlier start
/// is never taken for another's.
std::string wire_id(const Services& services, std::uint64_t number);
/// @errors kNotFound, with `field`: not an id of this start of the server.
Result<std::uint64_t> number_of(const Services& services,
                                const std::string& id,
                                std::string_view field);

/// An observation of a request.
/// @errors kNotFound: unknown, dropped, or of another start of the server; kInvalidArgument: set
/// for another map; both with field `observation_id`.
Result<service::StoredObservation> find_observation(Services& services,
                                                    const std::string& id,
                                                    const std::string& map_id);

using SharedObservation = std::shared_ptr<const similarity::PreparedObservation>;

/// What an observation has for the model of views.
/// @errors kFailedPrecondition, field `model`: it came without labels.
Result<SharedObservation> labels_of(const service::StoredObservation& stored);

/// How many poses a Score request may have, for what it asks of each.
std::size_t most_poses(const service::Limits& limits, const v1::ScoreRequest& wire);

/// Refuses work for which the queue has no room, or that would be begun too late.
/// @errors kResourceExhausted; with `field` if there is no room.
Status check_queue(const Services& services,
                   const Request& request,
                   std::size_t cells,
                   std::string_view field);

protocol::JobProgress progress_of(const Services& services, const service::JobStatus& status);

}  // namespace semview::server
