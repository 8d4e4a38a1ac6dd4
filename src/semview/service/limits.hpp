// SPDX-License-Identifier: Apache-2.0
/// Every limit on what comes from outside, in one place.
#pragma once

#include <cstddef>
#include <cstdint>

namespace semview::service {

/// Defaults fit a server for a few dozen robots on a machine with some GiB of memory.
struct Limits {
  std::size_t max_message_bytes = std::size_t{64} << 20U;  ///< of one request
  std::size_t max_poses = 200'000;                         ///< of one score request
  std::size_t max_curve_poses = 20'000;                    ///< with the whole heading curve
  std::size_t max_distorted_poses = 20'000;                ///< with an affine each
  std::size_t max_views = 4096;                            ///< cells of one request for views
  std::uint64_t max_pixels = 4'000'000;                    ///< of one exact view
  std::uint64_t max_request_pixels = 64'000'000;           ///< of all views of one request
  std::size_t max_observations = 1024;                     ///< kept at once, all clients together
  std::uint64_t max_observation_bytes = std::uint64_t{512} << 20U;  ///< of those, prepared
  std::size_t max_observations_per_client = 16;
  std::size_t max_in_flight_per_client = 64;
  std::uint64_t max_queued_cells = 2'000'000;  ///< estimated work of all waiting requests
  std::size_t max_clients = 1024;
  std::size_t max_running_jobs = 4;
  std::size_t max_finished_jobs = 256;  ///< kept for who asks how they ended
  std::size_t max_heat_map_cells = 4'000'000;
};

}  // namespace semview::service
