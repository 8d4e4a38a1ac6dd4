// SPDX-License-Identifier: Apache-2.0
#include "semview/cache/single_flight.hpp"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

namespace semview::cache {
namespace {

using Flights = SingleFlight<int, int>;

TEST(SingleFlightTest, TheFirstClaimantMakesTheValueAndTheOthersGetIt) {
  Flights flights;
  const std::vector<int> keys = {1, 2, 3};
  auto first = flights.claim(keys);
  EXPECT_EQ(first.mine(), (std::vector<std::size_t>{0, 1, 2}));
  const std::vector<int> wanted = {3, 4, 1};
  auto second = flights.claim(wanted);
  EXPECT_EQ(second.mine(), (std::vector<std::size_t>{1}));
  EXPECT_EQ(second.awaited(), 2U);
  second.complete({40});
  first.complete({10, 20, 30});
  std::vector<int> got(3, 0);
  ASSERT_TRUE(second.wait([&](std::size_t i, int value) { got[i] = value; }).has_value());
  EXPECT_EQ(got, (std::vector<int>{30, 0, 10}));
  EXPECT_EQ(flights.in_flight(), 0U);
}

TEST(SingleFlightTest, AFailureReachesEveryWaiterAndIsForgotten) {
  Flights flights;
  const std::vector<int> key = {1};
  auto first = flights.claim(key);
  auto second = flights.claim(key);
  second.complete({});
  first.fail({ErrorCode::kUnavailable, "no"});
  const Status waited = second.wait([](std::size_t, int) { FAIL(); });
  ASSERT_FALSE(waited.has_value());
  EXPECT_EQ(waited.error().code, ErrorCode::kUnavailable);
  EXPECT_EQ(flights.claim(key).mine().size(), 1U);
}

TEST(SingleFlightTest, AClaimThatIsDroppedAnswersItsWaiters) {
  Flights flights;
  const std::vector<int> key = {1};
  auto waiter = [&flights, &key] {
    auto first = flights.claim(key);
    return flights.claim(key);
  }();
  waiter.complete({});
  EXPECT_FALSE(waiter.wait([](std::size_t, int) { FAIL(); }).has_value());
  EXPECT_EQ(flights.in_flight(), 0U);
}

TEST(SingleFlightTest, ThreadsThatWantOverlappingKeysNeverWaitForEachOther) {
  Flights flights;
  std::atomic<int> answered{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 6; ++t) {
    threads.emplace_back([&flights, &answered, t] {
      for (int round = 0; round < 300; ++round) {
        const std::vector<int> keys = {(t + round) % 5, (t + round + 1) % 5, (t + round + 2) % 5};
        auto claim = flights.claim(keys);
        std::vector<int> values;
        for (const std::size_t i : claim.mine()) values.push_back(keys[i] * 10);
        claim.complete(std::move(values));
        const Status waited =
            claim.wait([&keys](std::size_t i, int value) { EXPECT_EQ(value, keys[i] * 10); });
        if (waited) ++answered;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(answered.load(), 6 * 300);
  EXPECT_EQ(flights.in_flight(), 0U);
}

}  // namespace
}  // namespace semview::cache
