// SPDX-License-Identifier: Apache-2.0
/// What a cached view is filed under.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "semview/core/hash.hpp"
#include "semview/core/result.hpp"
#include "semview/geometry/affine.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/view/view_profile.hpp"

namespace semview::cache {

inline constexpr std::size_t kMaxEngineName = 32;

/// Everything that decides what the views of a map look like: with the cell, the full key. A
/// changed map, engine or profile is another keyspace and can never meet an old view.
struct Keyspace {
  Fingerprint map;
  std::string engine;  ///< at most `kMaxEngineName` bytes
  std::uint32_t engine_version = 0;
  ViewProfile profile;
  MapAffine affine = {};  ///< how the plan is taken to be distorted

  bool operator==(const Keyspace&) const = default;
};

/// The keyspace as stored in each record, docs/formats/cache_record.md; equal keyspaces have equal
/// bytes.
std::vector<std::byte> to_bytes(const Keyspace& keyspace);

/// @errors kDataLoss: not the bytes of a keyspace, or bytes behind it.
Result<Keyspace> keyspace_from_bytes(std::span<const std::byte> bytes);

/// XXH3-128 of `to_bytes`: the short name of a keyspace.
Fingerprint digest(const Keyspace& keyspace);

/// The key of one view in memory.
struct ViewKey {
  Fingerprint keyspace;  ///< its digest
  CellIndex cell;

  bool operator==(const ViewKey&) const = default;
};

}  // namespace semview::cache

template <>
struct std::hash<semview::cache::ViewKey> {
  std::size_t operator()(const semview::cache::ViewKey& key) const noexcept;
};
