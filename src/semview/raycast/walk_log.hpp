// SPDX-License-Identifier: Apache-2.0
/// What a packet of walking rays met. Internal to this module.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "semview/raycast/column_walk.hpp"

namespace semview::raycast {

// Of steps, whose changes of profile one word a lane remembers.
constexpr std::size_t kBlock = 32;

/// What the lanes of a packet met in each of their steps. Keeps its memory.
struct WalkLog {
  std::vector<float> distances_m;     // step by step, lane by lane
  std::vector<std::int32_t> cells;    // the same; the high halves are not said
  std::vector<std::int32_t> changes;  // block by block, lane by lane: in which steps it changed

  void make_room(std::size_t blocks, std::size_t lanes) {
    if (changes.size() >= blocks * lanes) return;
    distances_m.resize(2 * blocks * kBlock * lanes);
    cells.resize(2 * blocks * kBlock * lanes);
    changes.resize(2 * blocks * lanes);
  }

  void append_crossings(std::size_t blocks,
                        std::size_t lane,
                        std::size_t lanes,
                        std::vector<Crossing>& crossings) const {
    for (std::size_t block = 0; block < blocks; ++block) {
      auto bits = static_cast<std::uint32_t>(changes[block * lanes + lane]);
      for (; bits != 0; bits &= bits - 1) {
        const std::size_t step = block * kBlock + static_cast<std::size_t>(std::countr_zero(bits));
        const std::size_t at = step * lanes + lane;
        const auto profile = (static_cast<std::uint32_t>(cells[at]) & kProfileBits) >> 8;
        crossings.push_back({distances_m[at], profile});
      }
    }
  }
};

using WalkLogs = std::array<WalkLog, 2>;

}  // namespace semview::raycast
