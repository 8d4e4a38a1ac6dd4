// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/interleave.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

namespace semview::benchmark {
namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Seconds an item of one pass over all of them.
double pass_s(const Contender& contender, ThreadPool& pool) {
  // A few tasks a thread: as the service cuts its work, and no thread ends long before the others.
  const std::size_t grain = std::max<std::size_t>(1, contender.items / (8 * pool.threads()));
  const double start_s = now_s();
  pool.parallel_for(contender.items, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) contender.item(i);
  });
  return (now_s() - start_s) / static_cast<double>(contender.items);
}

class Samples {
 public:
  void add(double seconds) { seconds_.push_back(seconds); }
  Timing timing() {
    std::ranges::sort(seconds_);
    return {seconds_.front(), seconds_[seconds_.size() / 2]};
  }

 private:
  std::vector<double> seconds_;
};

int passes_for(double wanted_s, double pass_s) {
  constexpr double kMostPasses = 100.0;
  return static_cast<int>(std::clamp(std::floor(wanted_s / pass_s), 1.0, kMostPasses));
}

}  // namespace

Turns take_turns(const Contender& ours,
                 const Contender& other,
                 ThreadPool& pool,
                 const TurnsConfig& config) {
  const double begin_s = now_s();
  const double ours_s = pass_s(ours, pool) * static_cast<double>(ours.items);
  const double other_s = pass_s(other, pool) * static_cast<double>(other.items);
  const int our_passes = passes_for(other_s / 10.0, ours_s);
  const int other_passes = passes_for(ours_s / 10.0, other_s);
  Samples our_samples;
  Samples other_samples;
  Turns turns;
  while (turns.rounds < config.fewest_rounds ||
         (turns.rounds < config.most_rounds && now_s() - begin_s < config.budget_s)) {
    for (int i = 0; i < our_passes; ++i) our_samples.add(pass_s(ours, pool));
    for (int i = 0; i < other_passes; ++i) other_samples.add(pass_s(other, pool));
    ++turns.rounds;
  }
  turns.ours = our_samples.timing();
  turns.other = other_samples.timing();
  return turns;
}

Timing time_alone(const Contender& work, ThreadPool& pool, const TurnsConfig& config) {
  const double begin_s = now_s();
  static_cast<void>(pass_s(work, pool));
  Samples samples;
  for (int round = 0; round < config.fewest_rounds ||
                      (round < config.most_rounds && now_s() - begin_s < config.budget_s);
       ++round) {
    samples.add(pass_s(work, pool));
  }
  return samples.timing();
}

}  // namespace semview::benchmark
