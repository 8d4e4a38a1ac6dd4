// SPDX-License-Identifier: Apache-2.0
#include "methods.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

#include "semview/map/semantic_map.hpp"
#include "semview/protocol/envelope.hpp"
#include "semview/protocol/map_wire.hpp"

namespace semview::server {
namespace {

struct Method {
  std::string_view name;
  std::uint64_t cells;  ///< of planning; a prepared observation costs as much as a chunk's half
  Result<Plan> (*plan)(Services&, const Request&);
};

constexpr std::array kMethods = {
    Method{"Hello", 1, plan_hello},
    Method{"ListMaps", 1, plan_list_maps},
    Method{"GetMap", 32, plan_get_map},
    Method{"GetViews", 1, plan_get_views},
    Method{"SetObservation", 32, plan_set_observation},
    Method{"Score", 4, plan_score},
    Method{"Heatmap", 4, plan_heatmap},
    Method{"StartPrecompute", 32, plan_start_precompute},
    Method{"JobStatus", 1, plan_job_status},
    Method{"CancelJob", 1, plan_cancel_job},
    Method{"GetStats", 1, plan_get_stats},
};

const Method* find_method(std::string_view name) {
  const auto found = std::find_if(
      kMethods.begin(), kMethods.end(), [name](const Method& m) { return m.name == name; });
  return found == kMethods.end() ? nullptr : &*found;
}

}  // namespace

std::span<const std::string_view> method_names() {
  static const auto names = [] {
    std::array<std::string_view, kMethods.size()> all;
    std::transform(
        kMethods.begin(), kMethods.end(), all.begin(), [](const Method& m) { return m.name; });
    return all;
  }();
  return names;
}

std::uint64_t planning_cells(std::string_view method) {
  const Method* const found = find_method(method);
  return found == nullptr ? 0 : found->cells;
}

Result<Plan> plan_request(Services& services, const Request& request) {
  const Method* const method = find_method(request.method);
  if (method == nullptr) {
    return fail(ErrorCode::kUnimplemented, fmt::format("method: '{}'", request.method));
  }
  return method->plan(services, request);
}

Result<std::shared_ptr<service::Site>> find_site(const Services& services,
                                                 const std::string& map_id,
                                                 const std::string& fingerprint) {
  Result<std::shared_ptr<service::Site>> site = services.maps.find(map_id);
  if (!site) {
    Error error = std::move(site).error();
    error.field = "map_id";
    return fail(std::move(error));
  }
  const Fingerprint& own = (*site)->map().fingerprint;
  if (!fingerprint.empty() && fingerprint != protocol::to_wire(own)) {
    return fail(Error{
        ErrorCode::kFailedPrecondition,
        fmt::format(
            "fingerprint: the server's map '{}' is {}, not the one named", map_id, to_hex(own)),
        "fingerprint",
        "the map was changed: ask for it again with GetMap"});
  }
  return site;
}

std::string wire_id(const Services& services, std::uint64_t number) {
  return fmt::format("{:016x}-{}", services.epoch, number);
}

Result<std::uint64_t> number_of(const Services& services,
                                const std::string& id,
                                std::string_view field) {
  const std::string prefix = fmt::format("{:016x}-", services.epoch);
  std::uint64_t number = 0;
  const char* const end = id.data() + id.size();
  const bool own = id.starts_with(prefix);
  const auto [stop, status] = std::from_chars(own ? id.data() + prefix.size() : end, end, number);
  if (status != std::errc() || stop != end) {
    return fail(Error{
        ErrorCode::kNotFound,
        fmt::format(
            "{}: '{}' was not given out by this start of the server", field, id.substr(0, 64)),
        std::string(field),
        "the server was restarted, or the id is another server's"});
  }
  return number;
}

Result<service::StoredObservation> find_observation(Services& services,
                                                    const std::string& id,
                                                    const std::string& map_id) {
  constexpr std::string_view kField = "observation_id";
  const Result<std::uint64_t> number = number_of(services, id, kField);
  Result<service::StoredObservation> stored =
      number ? services.observations.find(*number)
             : Result<service::StoredObservation>(fail(number.error()));
  if (!stored) {
    Error error = std::move(stored).error();
    error.field = kField;
    error.hint = "send it again with SetObservation";
    return fail(std::move(error));
  }
  if (stored->map_id != map_id) {
    return protocol::wrong_field(
        kField, fmt::format("was set for map '{}', not '{}'", stored->map_id, map_id));
  }
  return stored;
}

Result<SharedObservation> labels_of(const service::StoredObservation& stored) {
  if (stored.prepared != nullptr) return stored.prepared;
  return fail(Error{ErrorCode::kFailedPrecondition,
                    "the observation came without labels, and views are compared with labels",
                    "model",
                    "name a model of depth, or send `labels` with SetObservation"});
}

Status check_queue(const Services& services,
                   const Request& request,
                   std::size_t cells,
                   std::string_view field) {
  const std::uint64_t waiting = services.queued_cells();
  if (waiting + cells <= services.limits.max_queued_cells) {
    return services.check_wait(request, cells);
  }
  return fail(Error{ErrorCode::kResourceExhausted,
                    fmt::format("{}: {} cells on top of the {} that wait are more than {}",
                                field,
                                cells,
                                waiting,
                                services.limits.max_queued_cells),
                    std::string(field),
                    "the server is busy: send it again later",
                    kRetryAfter_ms});
}

}  // namespace semview::server
