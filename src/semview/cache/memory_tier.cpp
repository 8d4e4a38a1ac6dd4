// SPDX-License-Identifier: Apache-2.0
#include "semview/cache/memory_tier.hpp"

#include <algorithm>
#include <list>
#include <mutex>
#include <unordered_map>

namespace semview::cache {
namespace {

constexpr std::size_t kMaxShards = 16;
// Smaller shares would refuse large panoramas that the whole budget has room for.
constexpr std::uint64_t kShardBytes = std::uint64_t{16} << 20U;

}  // namespace

class MemoryTier::Shard {
 public:
  explicit Shard(std::uint64_t budget_bytes) : budget_(budget_bytes) {}

  SharedView get(const ViewKey& key) {
    const std::lock_guard lock(mutex_);
    const auto found = index_.find(key);
    if (found == index_.end()) {
      ++counters_.misses;
      return nullptr;
    }
    ++counters_.hits;
    entries_.splice(entries_.begin(), entries_, found->second);
    return found->second->view;
  }

  void put(const ViewKey& key, const SharedView& view) {
    const std::uint64_t bytes = view->byte_size() + kOverhead_bytes;
    Entries dropped;  // destroyed after the lock is released
    const std::lock_guard lock(mutex_);
    if (const auto found = index_.find(key); found != index_.end()) {
      entries_.splice(entries_.begin(), entries_, found->second);
      return;
    }
    if (bytes > budget_) {
      ++counters_.refused;
      return;
    }
    while (counters_.bytes + bytes > budget_) {
      const auto last = std::prev(entries_.end());
      index_.erase(last->key);
      counters_.bytes -= last->bytes;
      --counters_.views;
      ++counters_.evicted;
      dropped.splice(dropped.begin(), entries_, last);
    }
    entries_.push_front({key, view, bytes});
    index_.emplace(key, entries_.begin());
    counters_.bytes += bytes;
    ++counters_.views;
    ++counters_.stored;
  }

  StoreCounters counters() const {
    const std::lock_guard lock(mutex_);
    return counters_;
  }

 private:
  struct Entry {
    ViewKey key;
    SharedView view;
    std::uint64_t bytes = 0;
  };
  using Entries = std::list<Entry>;  // the one used last first

  const std::uint64_t budget_;
  mutable std::mutex mutex_;
  Entries entries_;
  std::unordered_map<ViewKey, Entries::iterator> index_;
  StoreCounters counters_;
};

MemoryTier::MemoryTier(std::uint64_t budget_bytes) {
  const std::uint64_t count = std::clamp<std::uint64_t>(budget_bytes / kShardBytes, 1, kMaxShards);
  for (std::uint64_t i = 0; i < count; ++i) {
    shards_.push_back(std::make_unique<Shard>(budget_bytes / count));
  }
}

MemoryTier::~MemoryTier() = default;

MemoryTier::Shard& MemoryTier::shard_of(const ViewKey& key) {
  // The upper bits: the shard's own table uses the lower ones.
  const std::size_t hash = std::hash<ViewKey>()(key) >> 40U;
  return *shards_[hash % shards_.size()];
}

std::vector<SharedView> MemoryTier::get(const Keyspace& keyspace,
                                        std::span<const CellIndex> cells) {
  const Fingerprint name = digest(keyspace);
  std::vector<SharedView> views;
  views.reserve(cells.size());
  for (const CellIndex& cell : cells) {
    const ViewKey key{name, cell};
    views.push_back(shard_of(key).get(key));
  }
  return views;
}

void MemoryTier::put(const Keyspace& keyspace,
                     std::span<const CellIndex> cells,
                     std::span<const SharedView> views) {
  const Fingerprint name = digest(keyspace);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const ViewKey key{name, cells[i]};
    shard_of(key).put(key, views[i]);
  }
}

StoreCounters MemoryTier::counters() const {
  StoreCounters sum;
  for (const auto& shard : shards_) sum += shard->counters();
  return sum;
}

}  // namespace semview::cache
