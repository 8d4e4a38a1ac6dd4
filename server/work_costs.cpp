// SPDX-License-Identifier: Apache-2.0
#include "work_costs.hpp"

#include <chrono>
#include <cmath>

namespace semview::server {
namespace {

/// What one more entry leaves of the weight of those before it: the last sixteen decide.
constexpr double kKept = 15.0 / 16.0;
/// Clients come and go. When so many entries are kept, all are forgotten: those who are still
/// there are known again after a request.
constexpr std::size_t kMostEntries = 10'000;

double seconds(Duration time) { return std::chrono::duration<double>(time).count(); }

void add(double& sum, double entry) { sum = kKept * sum + entry; }

Work work(double cells, double time_s) {
  return {static_cast<std::uint64_t>(std::llround(cells)),
          std::chrono::round<Duration>(std::chrono::duration<double>(time_s))};
}

}  // namespace

Work& Work::operator+=(const Work& more) {
  cells += more.cells;
  time += more.time;
  return *this;
}

Work& Work::operator-=(const Work& less) {
  cells -= less.cells;
  time -= less.time;
  return *this;
}

void WorkCosts::add_request(const std::string& client,
                            const std::string& method,
                            const Work& planning,
                            std::uint64_t cells) {
  const std::lock_guard lock(mutex_);
  for (Cost* cost : {&by_method_[method], &of_client(client, method)}) {
    add(cost->requests, 1.0);
    add(cost->planning_cells, static_cast<double>(planning.cells));
    add(cost->planning_s, seconds(planning.time));
    add(cost->cells, static_cast<double>(cells));
  }
}

void WorkCosts::add_part(const std::string& client, const std::string& method, const Work& part) {
  const std::lock_guard lock(mutex_);
  for (Cost* cost : {&by_method_[method], &of_client(client, method)}) {
    add(cost->done_cells, static_cast<double>(part.cells));
    add(cost->done_s, seconds(part.time));
  }
}

Work WorkCosts::of_request(const std::string& client, const std::string& method) const {
  const std::lock_guard lock(mutex_);
  const Cost* cost = find(client, method);
  if (cost == nullptr || cost->requests == 0.0) return {};
  const double n = cost->requests;
  return work((cost->planning_cells + cost->cells) / n,
              (cost->planning_s + cost->cells * cost->cell_s()) / n);
}

Work WorkCosts::of_purpose(const std::string& client, const std::string& method) const {
  Work work = of_request(client, method);
  if (method == "SetObservation") work += of_request(client, "Score");
  return work;
}

Work WorkCosts::of_part(const std::string& client,
                        const std::string& method,
                        std::uint64_t cells) const {
  const std::lock_guard lock(mutex_);
  const Cost* cost = find(client, method);
  if (cost == nullptr) return {cells, {}};
  const auto count = static_cast<double>(cells);
  return work(count, count * cost->cell_s());
}

std::string WorkCosts::key(const std::string& client, const std::string& method) {
  return method + '/' + client;
}

WorkCosts::Cost& WorkCosts::of_client(const std::string& client, const std::string& method) {
  if (by_client_.size() >= kMostEntries) by_client_.clear();
  return by_client_[key(client, method)];
}

const WorkCosts::Cost* WorkCosts::find(const std::string& client, const std::string& method) const {
  const auto own = by_client_.find(key(client, method));
  if (own != by_client_.end() && own->second.known()) {
    return &own->second;
  }
  const auto all = by_method_.find(method);
  return all == by_method_.end() ? nullptr : &all->second;
}

}  // namespace semview::server
