// SPDX-License-Identifier: Apache-2.0
// How LmdbStore comes to a directory: once a process, checked first, or only to read.
#include <condition_variable>
#include <map>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "semview/cache/lmdb_repair.hpp"
#include "semview/cache/lmdb_state.hpp"
#include "semview/core/log.hpp"

namespace semview::cache {
namespace {

/// The stores of this process by directory: LMDB must not open one twice in a process. An entry
/// goes when its store is closed, which is after the last reference to it is gone.
struct OpenStores {
  std::mutex mutex;
  std::condition_variable closed;
  std::map<std::filesystem::path, std::weak_ptr<LmdbStore>> by_directory;
};
OpenStores& open_stores() {
  static OpenStores stores;
  return stores;
}

}  // namespace

Result<std::shared_ptr<LmdbStore>> LmdbStore::open(const LmdbConfig& config) {
  std::error_code error;
  std::filesystem::path directory = std::filesystem::weakly_canonical(config.directory, error);
  if (error) directory = config.directory;
  OpenStores& stores = open_stores();
  std::shared_ptr<LmdbStore> store;  // outlives the lock: its end takes the lock
  std::unique_lock lock(stores.mutex);
  for (;;) {
    const auto known = stores.by_directory.find(directory);
    if (known == stores.by_directory.end()) break;
    store = known->second.lock();
    if (store != nullptr) {
      const LmdbConfig& other = store->state_->config;
      if (other.limit_bytes == config.limit_bytes && other.map_bytes == config.map_bytes) {
        return store;
      }
      return fail(ErrorCode::kFailedPrecondition,
                  fmt::format("cache {}: already open in this process with another limit",
                              config.directory.string()));
    }
    stores.closed.wait(lock);
  }
  SEMVIEW_TRY(std::unique_ptr<State> state, open_directory(config));
  store =
      std::shared_ptr<LmdbStore>(new LmdbStore(std::move(state)), [directory](LmdbStore* closing) {
        delete closing;
        const std::lock_guard closing_lock(open_stores().mutex);
        open_stores().by_directory.erase(directory);
        open_stores().closed.notify_all();
      });
  stores.by_directory[directory] = store;
  return store;
}

Result<std::unique_ptr<LmdbStore::State>> LmdbStore::open_directory(const LmdbConfig& config) {
  Result<detail::DirectoryLock> lock = detail::DirectoryLock::take(config.directory);
  std::error_code error;
  if (!lock && lock.error().code == ErrorCode::kPermissionDenied &&
      std::filesystem::exists(config.directory / "data.mdb", error)) {
    return open_read_only(config);
  }
  if (!lock) return fail(std::move(lock).error());
  std::optional<Rescue> rescue;
  if (lock->alone()) {
    std::filesystem::remove_all(config.directory / detail::kRewritingFolder, error);
    SEMVIEW_TRY(rescue, detail::mend_data_file(config.directory, config.map_bytes));
    lock->share();
  }
  SEMVIEW_TRY(detail::Environment environment,
              detail::Environment::open(config.directory, config.map_bytes));
  return std::make_unique<State>(
      config, *std::move(lock), std::move(environment), std::move(rescue));
}

Result<std::unique_ptr<LmdbStore::State>> LmdbStore::open_read_only(const LmdbConfig& config) {
  SEMVIEW_TRY_STATUS(detail::check_data_file(config.directory));
  SEMVIEW_TRY(detail::Environment environment,
              detail::Environment::open_read_only(config.directory, config.map_bytes));
  auto state = std::make_unique<State>(config, std::nullopt, std::move(environment), std::nullopt);
  state->storing = false;
  state->reason = "this process may not write to the directory";
  log_warning(
      fmt::format("cache {}: may only be read: no views are stored", config.directory.string()));
  return state;
}

}  // namespace semview::cache
