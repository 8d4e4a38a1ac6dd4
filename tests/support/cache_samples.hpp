// SPDX-License-Identifier: Apache-2.0
/// A keyspace, cells and views for tests of the cache.
#pragma once

#include <cstdint>
#include <vector>

#include "semview/cache/cache_key.hpp"
#include "support/random_view.hpp"

namespace semview::cache {

inline Keyspace test_keyspace(std::uint8_t map_byte = 1) {
  Keyspace keyspace;
  keyspace.map.bytes.fill(map_byte);
  keyspace.engine = "test";
  keyspace.engine_version = 3;
  keyspace.profile.camera = {120, 12, -0.5, 0.5};
  return keyspace;
}

inline std::vector<CellIndex> test_cells(std::int32_t count) {
  std::vector<CellIndex> cells;
  for (std::int32_t i = 0; i < count; ++i) cells.push_back({i % 7 - 3, i / 7 - 2});
  return cells;
}

inline std::vector<SharedView> test_views(std::size_t count, std::uint64_t seed = 0) {
  std::vector<SharedView> views;
  for (std::size_t i = 0; i < count; ++i) {
    views.push_back(testing::shared_random_view(seed + i));
  }
  return views;
}

}  // namespace semview::cache
