// SPDX-License-Identifier: Apache-2.0
#include "session.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "semview/core/random.hpp"
#include "semview/geometry/angle.hpp"

namespace semview::paper2023 {
namespace {

constexpr int kTries = 200;

std::size_t share_of(const Flat& flat, double share) {
  return static_cast<std::size_t>(std::lround(share * static_cast<double>(flat.things.size())));
}

/// In an order that the seed decides.
std::vector<std::int32_t> shuffled_ids(const Flat& flat, Rng& rng) {
  std::vector<std::int32_t> ids;
  for (const Thing& thing : flat.things) ids.push_back(thing.id);
  for (std::size_t i = ids.size(); i > 1; --i) std::swap(ids[i - 1], ids[rng.below(i)]);
  return ids;
}

/// Along its wall or, in the middle of the room, anywhere; free things turn as well.
bool move(const Flat& flat, const ChangeConfig& config, Rng& rng, Thing& thing) {
  const Thing before = thing;
  const bool free = thing.shape == ThingClass::kChair || thing.shape == ThingClass::kTable;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    const double far_m = rng.uniform(config.min_move_m, config.max_move_m);
    const double along_rad = free ? rng.uniform(-kPi, kPi) : (rng.below(2) == 0 ? 0.0 : kPi);
    thing.map_from_thing = before.map_from_thing *
                           Pose2{far_m * std::cos(along_rad), far_m * std::sin(along_rad), 0.0};
    if (free) {
      thing.map_from_thing.yaw_rad =
          wrap_angle(thing.map_from_thing.yaw_rad + rng.normal(0.0, 0.6));
    } else {
      thing.map_from_thing.yaw_rad = before.map_from_thing.yaw_rad;
    }
    if (fits(flat, thing)) return true;
  }
  thing = before;
  return false;
}

void add_things(std::size_t count, std::int32_t first_id, Rng& rng, Flat& flat) {
  using enum ThingClass;
  constexpr std::array<ThingClass, 6> kNewcomers = {kChair, kBox, kPlant, kLamp, kCabinet, kShelf};
  for (std::size_t i = 0; i < count; ++i) {
    for (int attempt = 0; attempt < kTries; ++attempt) {
      Thing thing;
      const ThingClass label = kNewcomers[rng.below(kNewcomers.size())];
      if (!place_thing(flat, label, rng.below(flat.rooms.size()), rng, thing)) continue;
      thing.id = first_id + static_cast<std::int32_t>(i);
      thing.named = rng.uniform() < flat.named;
      flat.things.push_back(thing);
      break;
    }
  }
}

}  // namespace

Flat change(const Flat& flat, const ChangeConfig& config, std::uint64_t seed) {
  Rng rng(seed, "changes");
  Flat changed = flat;
  const std::vector<std::int32_t> ids = shuffled_ids(flat, rng);
  auto next = ids.begin();
  const auto at = [&](std::int32_t id) {
    return std::ranges::find(changed.things, id, &Thing::id);
  };
  for (std::size_t i = 0; i < share_of(flat, config.removed); ++i) {
    changed.things.erase(at(*next++));
  }
  for (std::size_t renamed = 0; renamed < share_of(flat, config.renamed) && next != ids.end();) {
    Thing& thing = *at(*next++);
    if (!thing.named) continue;
    ++renamed;
    const auto other = 1 + rng.below(kThingClassCount - 1);  // steps on, never a whole round
    const auto label = (static_cast<std::uint64_t>(thing.name) - 1 + other) % kThingClassCount;
    thing.name = static_cast<ThingClass>(label + 1);
  }
  std::size_t moved = 0;
  for (; next != ids.end() && moved < share_of(flat, config.moved); ++next) {
    if (move(changed, config, rng, *at(*next))) ++moved;
  }
  const std::int32_t first_id = flat.things.empty() ? 1 : flat.things.back().id + 1;
  add_things(share_of(flat, config.added), first_id, rng, changed);
  return changed;
}

}  // namespace semview::paper2023
