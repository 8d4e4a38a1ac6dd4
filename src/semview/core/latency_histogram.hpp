// SPDX-License-Identifier: Apache-2.0
/// How long something takes, over a server's whole life, in constant memory.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "semview/core/clock.hpp"

namespace semview {

struct LatencySummary {
  std::uint64_t count = 0;
  double p50_ms = 0.0;
  double p95_ms = 0.0;
  double p99_ms = 0.0;
  double max_ms = 0.0;
};

/// Counts durations in steps of a sixteenth: percentiles are too high by at most 6.25 %, from a
/// microsecond to an hour; shorter and longer ones count as these.
/// @threads All members from several threads at once.
class LatencyHistogram {
 public:
  void add(Duration duration);
  /// The p50 is the upper end of the step in which the middle duration lies, and so on; but none
  /// is above the longest duration. All zero before the first.
  LatencySummary summary() const;

 private:
  /// Steps of an octave; below the first octave one a microsecond.
  static constexpr std::size_t kSteps = 16;
  static constexpr std::size_t kOctaves = 28;

  static std::size_t step_of(std::uint64_t microseconds);
  static std::uint64_t upper_end(std::size_t step);

  std::array<std::atomic<std::uint64_t>, kSteps*(kOctaves + 1)> counts_{};
  std::atomic<std::uint64_t> longest_{0};  ///< in microseconds
};

}  // namespace semview
