// SPDX-License-Identifier: Apache-2.0
/// Observations that clients have sent and will score against.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>

#include "semview/core/result.hpp"
#include "semview/service/limits.hpp"

namespace semview {
struct VoxelList;
namespace similarity {
class PreparedObservation;
}
}  // namespace semview

namespace semview::service {

/// One stored observation; `map_id` is the map whose classes it was prepared for.
struct StoredObservation {
  std::shared_ptr<const similarity::PreparedObservation> prepared;  ///< null: no labels were sent
  std::string map_id;
  std::shared_ptr<const VoxelList> voxels = {};  ///< null: no depth was sent
};

/// Observation ids are never used twice. A client that sends more than its share loses its own
/// oldest; when all are too many, the one longest unused goes, whosever it is.
/// @threads All members from several threads at once.
class ObservationStore {
 public:
  explicit ObservationStore(const Limits& limits);

  /// `bytes` is what the prepared observation holds.
  /// @errors kResourceExhausted: larger than the whole budget.
  Result<std::uint64_t> add(std::string_view client,
                            StoredObservation observation,
                            std::uint64_t bytes);

  /// @errors kNotFound: never given out, or evicted; the client sends the observation again.
  Result<StoredObservation> find(std::uint64_t id);

  struct Counters {
    std::size_t observations = 0;
    std::uint64_t bytes = 0;
    std::uint64_t evicted = 0;
  };
  Counters counters() const;

 private:
  struct Entry {
    std::uint64_t id = 0;
    std::string client;
    StoredObservation observation;
    std::uint64_t bytes = 0;
  };
  using Entries = std::list<Entry>;  // the most recently used first

  void evict(Entries::iterator entry);
  void make_room(std::string_view client, std::uint64_t bytes);

  const Limits limits_;
  mutable std::mutex mutex_;
  Entries entries_;
  std::unordered_map<std::uint64_t, Entries::iterator> by_id_;
  std::uint64_t next_id_ = 1;
  std::uint64_t bytes_ = 0;
  std::uint64_t evicted_ = 0;
};

}  // namespace semview::service
