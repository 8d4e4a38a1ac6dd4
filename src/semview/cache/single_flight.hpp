// SPDX-License-Identifier: Apache-2.0
/// Work that several threads want at once is done once.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "semview/core/check.hpp"
#include "semview/core/result.hpp"

namespace semview::cache {

/// Shares out keys between the threads that want them: the first to claim a key makes its value,
/// the others wait for it.
///
/// A thread must end its own claim (`complete` or `fail`) before it waits for others; so no two
/// threads can wait for each other. A claim that is dropped without an end fails: every waiter is
/// answered on every path, exceptions included.
/// @threads All members from several threads at once; a `Claim` belongs to one thread.
template <typename Key, typename Value>
class SingleFlight {
  /// The keys that one claim took.
  struct Flight {
    std::mutex mutex;
    std::condition_variable landed;
    std::optional<Result<std::vector<Value>>> outcome;  // values in the order of the claimed keys
  };
  /// Where the value of a key will be.
  struct Seat {
    std::shared_ptr<Flight> flight;
    std::size_t index = 0;
  };

 public:
  class Claim {
   public:
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;
    Claim(Claim&& other) noexcept
        : owner_(std::exchange(other.owner_, nullptr)),
          keys_(std::move(other.keys_)),
          mine_(std::move(other.mine_)),
          theirs_(std::move(other.theirs_)),
          flight_(std::move(other.flight_)) {}
    ~Claim() {
      if (owner_ != nullptr)
        fail({ErrorCode::kInternal, "the thread that made this value gave up"});
    }

    /// Indices, into the claimed keys, of those that this thread must make.
    const std::vector<std::size_t>& mine() const { return mine_; }
    /// How many keys other threads are making.
    std::size_t awaited() const { return theirs_.size(); }

    /// Hands out the values of `mine()`, in its order.
    void complete(std::vector<Value> values) {
      SEMVIEW_CHECK(values.size() == mine_.size());
      land(Result<std::vector<Value>>(std::move(values)));
    }
    void fail(Error error) { land(::semview::fail(std::move(error))); }

    /// Waits for the other threads and calls `take(index, value)` for each of their keys.
    /// @errors the first of their errors.
    template <typename Take>
    Status wait(Take&& take) {
      SEMVIEW_CHECK(owner_ == nullptr);
      for (const auto& [index, seat] : theirs_) {
        std::unique_lock lock(seat.flight->mutex);
        Flight& flight = *seat.flight;
        flight.landed.wait(lock, [&flight] { return flight.outcome.has_value(); });
        if (!*flight.outcome) return ::semview::fail(flight.outcome->error());
        take(index, (**flight.outcome)[seat.index]);
      }
      return {};
    }

   private:
    friend class SingleFlight;
    Claim(SingleFlight& owner, std::span<const Key> keys)
        : owner_(&owner), flight_(std::make_shared<Flight>()) {
      const std::lock_guard lock(owner.mutex_);
      for (std::size_t i = 0; i < keys.size(); ++i) {
        const auto [entry, is_new] = owner.seats_.try_emplace(keys[i], Seat{flight_, keys_.size()});
        if (is_new) {
          mine_.push_back(i);
          keys_.push_back(keys[i]);
        } else {
          SEMVIEW_CHECK(entry->second.flight != flight_);
          theirs_.emplace_back(i, entry->second);
        }
      }
    }

    void land(Result<std::vector<Value>> outcome) {
      SEMVIEW_CHECK(owner_ != nullptr);
      {
        const std::lock_guard lock(owner_->mutex_);
        for (const Key& key : keys_) owner_->seats_.erase(key);
      }
      owner_ = nullptr;
      {
        const std::lock_guard lock(flight_->mutex);
        flight_->outcome = std::move(outcome);
      }
      flight_->landed.notify_all();
    }

    SingleFlight* owner_;
    std::vector<Key> keys_;
    std::vector<std::size_t> mine_;
    std::vector<std::pair<std::size_t, Seat>> theirs_;
    std::shared_ptr<Flight> flight_;
  };

  /// Claims distinct `keys`. Values must be kept where a later claimant looks *before* the claim is
  /// completed, and a claimant must look there again after claiming: then nothing is made twice.
  Claim claim(std::span<const Key> keys) { return Claim(*this, keys); }

  /// Keys that are being made now.
  std::size_t in_flight() const {
    const std::lock_guard lock(mutex_);
    return seats_.size();
  }

 private:
  mutable std::mutex mutex_;
  std::unordered_map<Key, Seat> seats_;
};

}  // namespace semview::cache
