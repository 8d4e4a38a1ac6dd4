// SPDX-License-Identifier: Apache-2.0
/// The seam between the view cache and the tiers that keep views.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "semview/cache/cache_key.hpp"
#include "semview/view/column_view.hpp"

namespace semview::cache {

/// What a tier has done since it was opened.
struct StoreCounters {
  std::uint64_t hits = 0;
  std::uint64_t misses = 0;
  std::uint64_t stored = 0;   ///< views taken
  std::uint64_t evicted = 0;  ///< views dropped for room
  std::uint64_t refused = 0;  ///< views not taken: no room, or storing has stopped
  std::uint64_t damaged = 0;  ///< records with a wrong checksum or shape
  std::uint64_t foreign = 0;  ///< records that name another key
  std::uint64_t unknown = 0;  ///< records of a format or codec that this program does not know
  std::uint64_t bytes = 0;    ///< held now
  std::uint64_t views = 0;    ///< held now; 0 where counting would be slow
  bool storing = true;        ///< false once a full or failing disk has stopped it

  /// As of one tier that is made of both.
  StoreCounters& operator+=(const StoreCounters& other) {
    hits += other.hits;
    misses += other.misses;
    stored += other.stored;
    evicted += other.evicted;
    refused += other.refused;
    damaged += other.damaged;
    foreign += other.foreign;
    unknown += other.unknown;
    bytes += other.bytes;
    views += other.views;
    storing = storing && other.storing;
    return *this;
  }
};

/// Keeps views for later, as well as it can.
///
/// A tier is a convenience: it may forget anything at any time, it never fails a request, and what
/// it gives back is equal to what was put. Its troubles show in its counters (and, once, in the
/// log). tests/support/view_store_contract.hpp holds these requirements as tests.
/// @threads All members from several threads at once.
class ViewStore {
 public:
  virtual ~ViewStore() = default;

  /// One view a cell in the order of `cells`, null where the tier has none.
  virtual std::vector<SharedView> get(const Keyspace& keyspace,
                                      std::span<const CellIndex> cells) = 0;

  /// Offers views; `views[i]` belongs to `cells[i]` and is not null. A view that is there already
  /// may be replaced: it is equal.
  virtual void put(const Keyspace& keyspace,
                   std::span<const CellIndex> cells,
                   std::span<const SharedView> views) = 0;

  virtual StoreCounters counters() const = 0;
};

}  // namespace semview::cache
