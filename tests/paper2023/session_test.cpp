// SPDX-License-Identifier: Apache-2.0
#include "experiments/paper2023/session.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace semview::paper2023 {
namespace {

struct Changes {
  std::size_t removed = 0;
  std::size_t moved = 0;
  std::size_t added = 0;
  std::size_t renamed = 0;
};

Changes between(const Flat& before, const Flat& after, const ChangeConfig& config) {
  Changes changes;
  for (const Thing& thing : before.things) {
    const auto now = std::ranges::find(after.things, thing.id, &Thing::id);
    if (now == after.things.end()) {
      ++changes.removed;
      continue;
    }
    const double far_m = distance_m(now->map_from_thing, thing.map_from_thing);
    const bool moved = far_m > 0.0;
    const bool renamed = now->name != thing.name;
    if (moved) {
      EXPECT_GE(far_m, config.min_move_m - 1e-9);
      EXPECT_LE(far_m, config.max_move_m + 1e-9);
    }
    EXPECT_FALSE(moved && renamed);
    EXPECT_EQ(now->shape, thing.shape);
    changes.moved += moved ? 1 : 0;
    changes.renamed += renamed ? 1 : 0;
  }
  const std::int32_t last = before.things.back().id;
  for (const Thing& thing : after.things) changes.added += thing.id > last ? 1 : 0;
  return changes;
}

TEST(SessionTest, AsManyThingsChangeAsTheSharesSay) {
  const ChangeConfig config;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Flat flat = draw_flat({}, seed);
    const Flat later = change(flat, config, seed + 100);
    const auto count = [&](double share) {
      return static_cast<std::size_t>(std::lround(share * static_cast<double>(flat.things.size())));
    };
    const Changes changes = between(flat, later, config);
    EXPECT_EQ(changes.removed, count(config.removed));
    EXPECT_EQ(changes.moved, count(config.moved));
    EXPECT_EQ(changes.added, count(config.added));
    EXPECT_EQ(changes.renamed, count(config.renamed));
    for (const Thing& thing : later.things) EXPECT_TRUE(fits(later, thing));
  }
}

TEST(SessionTest, WithoutSharesNothingChanges) {
  const ChangeConfig config{0.0, 0.0, 0.0, 0.0};
  const Flat flat = draw_flat({}, 2);
  const Changes changes = between(flat, change(flat, config, 5), config);
  EXPECT_EQ(changes.removed + changes.moved + changes.added + changes.renamed, 0U);
}

TEST(SessionTest, AnotherSeedIsAnotherDay) {
  const Flat flat = draw_flat({}, 2);
  const Flat one = change(flat, {}, 5);
  const Flat same = change(flat, {}, 5);
  const Flat other = change(flat, {}, 6);
  const auto ids = [](const Flat& of) {
    std::vector<std::int32_t> all;
    for (const Thing& thing : of.things) all.push_back(thing.id);
    return all;
  };
  EXPECT_EQ(ids(one), ids(same));
  EXPECT_NE(ids(one), ids(other));
}

}  // namespace
}  // namespace semview::paper2023
