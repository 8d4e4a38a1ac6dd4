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
  // The first item also begins each turn.
  for (const int count : {ours[2], ours[3], ours[4], ours[0] - 4}) EXPECT_EQ(count, ours[1]);
  EXPECT_EQ(other[0] - 4, other[1]);
  EXPECT_GE(ours[1], 5);  // one to warm up
  EXPECT_GE(other[1], 5);
}

TEST(InterleaveTest, OneThreadIsTimedByItsOwnClockSoWaitingCostsNothing) {
  ThreadPool alone(1);
  ThreadPool two(2);
  EXPECT_EQ(clock_for(alone), TurnsClock::kThread);
  EXPECT_EQ(clock_for(two), TurnsClock::kWall);
  const Contender work{1, [](std::size_t) {}};
  EXPECT_EQ(name_of(take_turns(work, work, alone, {0.0, 1, 1}).clock), "thread");
  EXPECT_EQ(name_of(take_turns(work, work, two, {0.0, 1, 1}).clock), "wall");
}

TEST(InterleaveTest, PassesFillTheTimeWantedAndNoTimeAtAllIsOnePass) {
  EXPECT_EQ(passes_for(1.0, 0.3), 3);
  EXPECT_EQ(passes_for(0.1, 0.3), 1);
  EXPECT_EQ(passes_for(1.0, 1e-9), 100);
  EXPECT_EQ(passes_for(0.0, 0.0), 1);
  EXPECT_EQ(passes_for(1.0, 0.0), 1);
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
