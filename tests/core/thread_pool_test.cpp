// SPDX-License-Identifier: Apache-2.0
#include "semview/core/thread_pool.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <pthread.h>

namespace semview {
namespace {

/// No thread can be made while it lives: none gets a stack of that size.
class NoNewThreads {
 public:
  NoNewThreads() {
    pthread_getattr_default_np(&before_);
    pthread_attr_t huge;
    pthread_attr_init(&huge);
    pthread_attr_setstacksize(&huge, std::size_t{1} << 50U);
    pthread_setattr_default_np(&huge);
    pthread_attr_destroy(&huge);
  }
  ~NoNewThreads() {
    pthread_setattr_default_np(&before_);
    pthread_attr_destroy(&before_);
  }

 private:
  pthread_attr_t before_;
};

TEST(ThreadPoolStartTest, WithoutNewThreadsTheCallerDoesTheWorkAndALineSaysSo) {
  ::testing::internal::CaptureStderr();
  const NoNewThreads none;
  ThreadPool pool(4);
  EXPECT_EQ(pool.threads(), 1U);
  std::atomic<int> visits{0};
  pool.parallel_for(10, 1, [&](std::size_t, std::size_t) { ++visits; });
  EXPECT_EQ(visits, 10);
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("of 4 threads only 1 could be made: "), std::string::npos) << said;
}

class ThreadPoolTest : public ::testing::TestWithParam<std::size_t> {};

TEST_P(ThreadPoolTest, EveryIndexIsVisitedOnce) {
  ThreadPool pool(GetParam());
  for (const std::size_t count : {0U, 1U, 7U, 1000U}) {
    for (const std::size_t grain : {1U, 3U, 64U, 5000U}) {
      // Plain ints: a second visit from another thread would also be a data race.
      std::vector<int> visits(count, 0);
      std::atomic<bool> ranges_fit{true};
      pool.parallel_for(count, grain, [&](std::size_t begin, std::size_t end) {
        if (begin >= end || end - begin > grain || end > count) ranges_fit = false;
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      EXPECT_TRUE(ranges_fit);
      EXPECT_TRUE(std::ranges::all_of(visits, [](int n) { return n == 1; }));
    }
  }
}

TEST_P(ThreadPoolTest, ALoopMayRunInsideALoop) {
  ThreadPool pool(GetParam());
  std::atomic<int> total{0};
  pool.parallel_for(8, 1, [&](std::size_t, std::size_t) {
    pool.parallel_for(
        8, 1, [&](std::size_t begin, std::size_t end) { total += static_cast<int>(end - begin); });
  });
  EXPECT_EQ(total, 64);
}

TEST_P(ThreadPoolTest, SeveralThreadsMayUseOnePool) {
  ThreadPool pool(GetParam());
  std::vector<std::size_t> sums(4, 0);
  {
    std::vector<std::jthread> callers;
    for (std::size_t& sum : sums) {
      callers.emplace_back([&pool, &sum] {
        for (int repeat = 0; repeat < 50; ++repeat) {
          std::vector<std::size_t> squares(100);
          pool.parallel_for(100, 9, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) squares[i] = i * i;
          });
          sum += std::accumulate(squares.begin(), squares.end(), std::size_t{0});
        }
      });
    }
  }
  for (const std::size_t sum : sums) EXPECT_EQ(sum, 50U * 328'350U);
}

INSTANTIATE_TEST_SUITE_P(Threads, ThreadPoolTest, ::testing::Values(1, 2, 5));

TEST(ThreadPoolSizeTest, CountsTheCaller) {
  EXPECT_EQ(ThreadPool(1).threads(), 1U);
  EXPECT_EQ(ThreadPool(3).threads(), 3U);
  EXPECT_GE(ThreadPool(0).threads(), 1U);
}

}  // namespace
}  // namespace semview
