// SPDX-License-Identifier: Apache-2.0
/// What a server did under a load.
#pragma once

#include <cstddef>
#include <vector>

#include "semview/core/clock.hpp"

namespace semview::client {

/// The cycles of a run, and how long each took from the moment at which it was meant to begin.
///
/// A cycle that was refused, failed, or not answered in time is not left out of the percentiles: it
/// counts as long as the time limit, or else a server could look quick by answering little.
struct LoadReport {
  double seconds = 0.0;       ///< in which cycles were to begin
  std::size_t cycles = 0;     ///< that were to begin
  std::size_t answered = 0;   ///< of these: with their scores, before the time limit
  std::size_t in_time = 0;    ///< of these: soon enough for a robot (`LoadConfig::in_time`)
  std::size_t refused = 0;    ///< RESOURCE_EXHAUSTED
  std::size_t failed = 0;     ///< any other error
  std::size_t timed_out = 0;  ///< too late for the server, or no answer before the time limit
  double p50_ms = 0.0;
  double p95_ms = 0.0;
  double p99_ms = 0.0;
  double max_ms = 0.0;
  /// How late the generator itself began a cycle, at worst; part of the times above.
  double worst_start_ms = 0.0;

  /// Cycles a second that were answered in time.
  double goodput_hz() const;
};

/// The smallest entry that a share `p` of all entries does not exceed; `sorted` is not empty.
double percentile(const std::vector<double>& sorted, double p);

/// Fills in the percentiles; `times_ms` has one entry a cycle.
void add_percentiles(std::vector<double> times_ms, LoadReport* report);

}  // namespace semview::client
