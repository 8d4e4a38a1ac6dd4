// SPDX-License-Identifier: Apache-2.0
/// What an open LmdbStore holds; for the sources of this module.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "semview/cache/lmdb_handles.hpp"
#include "semview/cache/lmdb_store.hpp"
#include "semview/cache/record.hpp"

namespace semview::cache {
namespace detail {

enum class RecordState { kSound, kDamaged, kForeign, kUnknown };

}  // namespace detail

struct LmdbStore::State {
  State(LmdbConfig the_config,
        std::optional<detail::DirectoryLock> the_lock,
        detail::Environment the_environment,
        std::optional<Rescue> the_rescue)
      : config(std::move(the_config)),
        lock(std::move(the_lock)),
        environment(std::move(the_environment)),
        rescue(std::move(the_rescue)) {}

  /// A record that cannot be served.
  void count(detail::RecordState found) {
    if (found == detail::RecordState::kDamaged) ++damaged;
    if (found == detail::RecordState::kForeign) ++foreign;
    if (found == detail::RecordState::kUnknown) ++unknown;
  }

  LmdbConfig config;
  std::optional<detail::DirectoryLock> lock;  // none: read only
  detail::Environment environment;
  std::optional<Rescue> rescue;
  std::atomic<bool> storing{true};
  std::atomic<std::uint64_t> hits{0};
  std::atomic<std::uint64_t> misses{0};
  std::atomic<std::uint64_t> stored{0};
  std::atomic<std::uint64_t> refused{0};
  std::atomic<std::uint64_t> damaged{0};
  std::atomic<std::uint64_t> foreign{0};
  std::atomic<std::uint64_t> unknown{0};
  std::atomic<bool> read_failure_logged{false};
  std::mutex reason_mutex;
  std::string reason;  // why storing has stopped
};

namespace detail {

/// Checks all but the payload's content. `record` is set when the state is `kSound`.
RecordState inspect(std::span<const std::byte> key,
                    std::span<const std::byte> bytes,
                    std::optional<Record>& record);

inline constexpr std::array kDescriptionMagic = {
    std::byte{'S'}, std::byte{'V'}, std::byte{'W'}, std::byte{'K'}};

/// The description of a keyspace in its table.
std::vector<std::byte> describe(const Keyspace& keyspace,
                                const std::string& map_id,
                                std::span<const CellIndex> map_cells);
Result<KeyspaceEntry> read_description(std::span<const std::byte> bytes);

/// As `record_length`, of a description.
std::size_t description_length(std::span<const std::byte> bytes);

}  // namespace detail
}  // namespace semview::cache
