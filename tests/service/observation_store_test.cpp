// SPDX-License-Identifier: Apache-2.0
#include "semview/service/observation_store.hpp"

#include <gtest/gtest.h>

#include "semview/similarity/prepared_observation.hpp"

namespace semview::service {
namespace {

Limits small_limits() {
  Limits limits;
  limits.max_observations = 4;
  limits.max_observations_per_client = 2;
  limits.max_observation_bytes = 1000;
  return limits;
}

StoredObservation of_map(const char* map_id) { return {nullptr, map_id}; }

TEST(ObservationStoreTest, GivesBackWhatItTookUnderANewIdEachTime) {
  ObservationStore store(small_limits());
  const auto first = store.add("a", of_map("m1"), 10);
  const auto second = store.add("a", of_map("m2"), 10);
  ASSERT_TRUE(first.has_value() && second.has_value());
  EXPECT_NE(*first, *second);
  EXPECT_EQ(store.find(*first)->map_id, "m1");
  EXPECT_EQ(store.find(*second)->map_id, "m2");
  EXPECT_EQ(store.find(99).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(store.find(0).error().field, "observation_id");
}

TEST(ObservationStoreTest, AClientPastItsShareLosesItsOwnOldest) {
  ObservationStore store(small_limits());
  const auto other = store.add("b", of_map("m"), 10);
  const auto first = store.add("a", of_map("m"), 10);
  const auto second = store.add("a", of_map("m"), 10);
  ASSERT_TRUE(store.find(*first).has_value());  // used again: now `second` is the oldest
  const auto third = store.add("a", of_map("m"), 10);
  EXPECT_TRUE(store.find(*other).has_value());
  EXPECT_TRUE(store.find(*first).has_value());
  EXPECT_FALSE(store.find(*second).has_value());
  EXPECT_TRUE(store.find(*third).has_value());
}

TEST(ObservationStoreTest, KeepsWithinItsCountAndBytes) {
  ObservationStore store(small_limits());
  std::vector<std::uint64_t> ids;
  for (const char* client : {"a", "b", "c", "d", "e"}) {
    ids.push_back(*store.add(client, of_map("m"), 10));
  }
  EXPECT_EQ(store.counters().observations, 4U);
  EXPECT_FALSE(store.find(ids[0]).has_value());
  const auto large = store.add("f", of_map("m"), 990);
  ASSERT_TRUE(large.has_value());
  EXPECT_LE(store.counters().bytes, 1000U);
  EXPECT_TRUE(store.find(ids[4]).has_value() || store.counters().observations == 1);
  EXPECT_EQ(store.add("f", of_map("m"), 1001).error().code, ErrorCode::kResourceExhausted);
}

}  // namespace
}  // namespace semview::service
