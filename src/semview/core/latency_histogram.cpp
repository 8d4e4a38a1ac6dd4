// SPDX-License-Identifier: Apache-2.0
#include "semview/core/latency_histogram.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <vector>

namespace semview {
namespace {

constexpr std::uint64_t kLongest = std::uint64_t{3600} * 1'000'000;

}  // namespace

void LatencyHistogram::add(Duration duration) {
  const auto microseconds = std::chrono::ceil<std::chrono::microseconds>(duration).count();
  const auto clamped =
      static_cast<std::uint64_t>(std::clamp<std::int64_t>(microseconds, 1, kLongest));
  counts_[step_of(clamped)].fetch_add(1, std::memory_order_relaxed);
  std::uint64_t longest = longest_.load(std::memory_order_relaxed);
  while (clamped > longest && !longest_.compare_exchange_weak(longest, clamped)) {
  }
}

LatencySummary LatencyHistogram::summary() const {
  std::vector<std::uint64_t> counts(counts_.begin(), counts_.end());
  LatencySummary summary;
  for (const std::uint64_t count : counts) summary.count += count;
  if (summary.count == 0) return summary;
  const std::uint64_t longest = longest_;
  const auto percentile_ms = [&](double p) {
    const double rank = std::ceil(p * static_cast<double>(summary.count));
    std::uint64_t seen = 0;
    std::size_t step = 0;
    while (step + 1 < counts.size() && static_cast<double>(seen + counts[step]) < rank) {
      seen += counts[step++];
    }
    return static_cast<double>(std::min(upper_end(step), longest)) / 1000.0;
  };
  summary.p50_ms = percentile_ms(0.50);
  summary.p95_ms = percentile_ms(0.95);
  summary.p99_ms = percentile_ms(0.99);
  summary.max_ms = static_cast<double>(longest) / 1000.0;
  return summary;
}

/// Step s of octave o > 0 holds [(16 + s) · 2^(o-1), (17 + s) · 2^(o-1)) microseconds, octave 0 the
/// numbers below 16.
std::size_t LatencyHistogram::step_of(std::uint64_t microseconds) {
  if (microseconds < kSteps) return static_cast<std::size_t>(microseconds);
  const auto octave = static_cast<std::size_t>(std::bit_width(microseconds)) - 4;
  return octave * kSteps + static_cast<std::size_t>(microseconds >> (octave - 1)) - kSteps;
}

std::uint64_t LatencyHistogram::upper_end(std::size_t step) {
  const std::size_t octave = step / kSteps;
  if (octave == 0) return step;
  return ((kSteps + step % kSteps + 1) << (octave - 1)) - 1;
}

}  // namespace semview
