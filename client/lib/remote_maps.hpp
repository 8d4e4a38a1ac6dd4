// SPDX-License-Identifier: Apache-2.0
/// What a server tells of its maps, and its long jobs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/lib/connection.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/protocol/descriptions.hpp"

namespace semview::v1 {
class Region;
}

namespace semview::client {

/// @errors those of `Connection::call`.
Result<std::vector<protocol::MapSummary>> list_maps(Connection& connection);

/// Classes, profile, engine, fingerprint and the free cells of a map.
/// @errors kNotFound: no such map; those of `Connection::call`.
Result<protocol::MapDescription> get_map(Connection& connection,
                                         const std::string& map_id,
                                         bool with_glb = false);

/// A rectangle in frame `map`, metres.
struct Region {
  double x_min_m = 0.0;
  double y_min_m = 0.0;
  double x_max_m = 0.0;
  double y_max_m = 0.0;
};

void to_wire(const Region& region, v1::Region* wire);

struct PrecomputeRequest {
  std::string map_id;
  std::optional<Region> region;
  std::optional<Pose2> reachable_from;  ///< its yaw is not used
};

/// Starts a job that fills the server's cache; returns the job's id.
Result<std::string> start_precompute(Connection& connection, const PrecomputeRequest& request);
/// @errors kNotFound: the server does not know the job (it may have been restarted).
Result<protocol::JobProgress> job_status(Connection& connection, const std::string& job_id);
Status cancel_job(Connection& connection, const std::string& job_id);

}  // namespace semview::client
