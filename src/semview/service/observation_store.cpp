// SPDX-License-Identifier: Apache-2.0
#include "semview/service/observation_store.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace semview::service {

ObservationStore::ObservationStore(const Limits& limits) : limits_(limits) {}

Result<std::uint64_t> ObservationStore::add(std::string_view client,
                                            StoredObservation observation,
                                            std::uint64_t bytes) {
  if (bytes > limits_.max_observation_bytes) {
    return fail(ErrorCode::kResourceExhausted,
                fmt::format("an observation of {} bytes is above the limit of {} bytes",
                            bytes,
                            limits_.max_observation_bytes));
  }
  const std::lock_guard lock(mutex_);
  make_room(client, bytes);
  const std::uint64_t id = next_id_++;
  entries_.push_front({id, std::string(client), std::move(observation), bytes});
  by_id_.emplace(id, entries_.begin());
  bytes_ += bytes;
  return id;
}

Result<StoredObservation> ObservationStore::find(std::uint64_t id) {
  const std::lock_guard lock(mutex_);
  const auto found = by_id_.find(id);
  if (found == by_id_.end()) {
    return fail(Error{ErrorCode::kNotFound,
                      fmt::format("no observation {}", id),
                      "observation_id",
                      "send it again with SetObservation"});
  }
  entries_.splice(entries_.begin(), entries_, found->second);
  return found->second->observation;
}

ObservationStore::Counters ObservationStore::counters() const {
  const std::lock_guard lock(mutex_);
  return {entries_.size(), bytes_, evicted_};
}

void ObservationStore::evict(Entries::iterator entry) {
  bytes_ -= entry->bytes;
  by_id_.erase(entry->id);
  entries_.erase(entry);
  ++evicted_;
}

void ObservationStore::make_room(std::string_view client, std::uint64_t bytes) {
  const auto is_own = [client](const Entry& entry) { return entry.client == client; };
  const auto own = static_cast<std::size_t>(std::ranges::count_if(entries_, is_own));
  if (own >= limits_.max_observations_per_client) {
    const auto last = std::find_if(entries_.rbegin(), entries_.rend(), is_own);
    evict(std::prev(last.base()));
  }
  while (!entries_.empty() && (entries_.size() >= limits_.max_observations ||
                               bytes_ + bytes > limits_.max_observation_bytes)) {
    evict(std::prev(entries_.end()));
  }
}

}  // namespace semview::service
