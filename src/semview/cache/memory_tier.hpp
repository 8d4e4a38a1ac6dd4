// SPDX-License-Identifier: Apache-2.0
/// The views used last, in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "semview/cache/view_store.hpp"

namespace semview::cache {

/// Keeps the most recently used views within a budget of bytes, which it never exceeds, not even
/// for a moment.
///
/// The views are spread over shards by their key, each with a lock, a share of the budget and an
/// LRU order of its own. A view larger than a shard's share is refused.
class MemoryTier final : public ViewStore {
 public:
  /// What a view costs besides its own bytes, as glibc allocates on 64 bits: list node 80, index
  /// entry 48 and its bucket 12 to 16, shared count 16, and what five allocations round up.
  static constexpr std::size_t kOverhead_bytes = 208;

  explicit MemoryTier(std::uint64_t budget_bytes);
  ~MemoryTier() override;

  std::vector<SharedView> get(const Keyspace& keyspace, std::span<const CellIndex> cells) override;
  void put(const Keyspace& keyspace,
           std::span<const CellIndex> cells,
           std::span<const SharedView> views) override;
  StoreCounters counters() const override;

 private:
  class Shard;
  Shard& shard_of(const ViewKey& key);

  std::vector<std::unique_ptr<Shard>> shards_;
};

}  // namespace semview::cache
