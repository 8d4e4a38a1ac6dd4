// SPDX-License-Identifier: Apache-2.0
#include "client/load/load_report.hpp"

#include <algorithm>
#include <cmath>

namespace semview::client {

double LoadReport::goodput_hz() const {
  return seconds > 0.0 ? static_cast<double>(in_time) / seconds : 0.0;
}

double percentile(const std::vector<double>& sorted, double p) {
  const double rank = std::ceil(p * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

void add_percentiles(std::vector<double> times_ms, LoadReport* report) {
  if (times_ms.empty()) return;
  std::ranges::sort(times_ms);
  report->p50_ms = percentile(times_ms, 0.50);
  report->p95_ms = percentile(times_ms, 0.95);
  report->p99_ms = percentile(times_ms, 0.99);
  report->max_ms = times_ms.back();
}

}  // namespace semview::client
