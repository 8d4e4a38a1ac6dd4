// SPDX-License-Identifier: Apache-2.0
/// What a running service has done, for GetStats and the log.
#pragma once

#include <cstddef>
#include <cstdint>

#include "semview/cache/view_cache.hpp"

namespace semview::service {

struct ServiceCounters {
  cache::ViewCacheCounters cache;
  std::size_t maps = 0;
  std::size_t observations = 0;
  std::uint64_t observation_bytes = 0;
  std::uint64_t observations_evicted = 0;
  std::size_t jobs_running = 0;
  std::uint64_t jobs_done = 0;
  std::uint64_t jobs_failed = 0;
  std::uint64_t jobs_cancelled = 0;
};

}  // namespace semview::service
