// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/interleave.hpp"

#include <atomic>
#include <vector>

#include <gtest/gtest.h>

namespace semview::benchmark {
namespace {

TEST(InterleaveTest, BothSidesDoAllTheirItemsEqualTimesInTurn) {
  ThreadPool pool(1);
  std::vector<int> ours(5, 0);
  std::vector<int> other(2, 0);
  const Turns turns = take_turns({5, [&](std::size_t i) { ++ours[i]; }},
                                 {2, [&](std::size_t i) { ++other[i]; }},
                                 pool,
                                 {0.0, 4, 4});
  EXPECT_EQ(turns.rounds, 4);
  for (const int count : ours) EXPECT_EQ(count, ours[0]);
  for (const int count : other) EXPECT_EQ(count, other[0]);
  EXPECT_GE(ours[0], 5);  // one to warm up
  EXPECT_GE(other[0], 5);
}

TEST(InterleaveTest, TheLeastIsNotAboveTheMedian) {
  ThreadPool pool(2);
  std::atomic<int> done = 0;
  const Contender work{64, [&](std::size_t) { ++done; }};
  const Timing time = time_alone(work, pool, {0.0, 9, 9});
  EXPECT_EQ(done, 10 * 64);
  EXPECT_GT(time.least_s, 0.0);
  EXPECT_LE(time.least_s, time.median_s);
}

}  // namespace
}  // namespace semview::benchmark
