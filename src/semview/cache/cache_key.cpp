// SPDX-License-Identifier: Apache-2.0
#include "semview/cache/cache_key.hpp"

#include <algorithm>
#include <cstring>

#include "semview/cache/bytes.hpp"
#include "semview/core/check.hpp"

namespace semview::cache {

std::vector<std::byte> to_bytes(const Keyspace& keyspace) {
  SEMVIEW_CHECK(keyspace.engine.size() <= kMaxEngineName);
  const PanoramaCamera& camera = keyspace.profile.camera;
  detail::ByteWriter out;
  out.add_bytes(std::as_bytes(std::span(keyspace.map.bytes)));
  out.add(static_cast<std::uint8_t>(keyspace.engine.size()));
  out.add_bytes(std::as_bytes(std::span(keyspace.engine)));
  out.add(keyspace.engine_version);
  out.add(static_cast<std::uint16_t>(camera.columns));
  out.add(static_cast<std::uint16_t>(camera.rows));
  out.add_f64(camera.elevation_min_rad);
  out.add_f64(camera.elevation_max_rad);
  out.add_f64(keyspace.profile.eye_height_m);
  // Nothing where there are none: caches from before there were ranges keep their keys.
  if (keyspace.profile.ranges) out.add(std::uint8_t{1});
  if (!keyspace.affine.is_identity()) {
    out.add_f64(keyspace.affine.a);
    out.add_f64(keyspace.affine.b);
    out.add_f64(keyspace.affine.k);
  }
  return std::move(out).take();
}

Result<Keyspace> keyspace_from_bytes(std::span<const std::byte> bytes) {
  detail::ByteReader in(bytes);
  Keyspace keyspace;
  std::ranges::transform(in.take_bytes(keyspace.map.bytes.size()),
                         keyspace.map.bytes.begin(),
                         [](std::byte byte) { return static_cast<std::uint8_t>(byte); });
  const auto engine_length = in.take<std::uint8_t>();
  if (engine_length > kMaxEngineName)
    return fail(ErrorCode::kDataLoss, "key: engine name too long");
  keyspace.engine = in.take_string(engine_length);
  keyspace.engine_version = in.take<std::uint32_t>();
  PanoramaCamera& camera = keyspace.profile.camera;
  camera.columns = in.take<std::uint16_t>();
  camera.rows = in.take<std::uint16_t>();
  camera.elevation_min_rad = in.take_f64();
  camera.elevation_max_rad = in.take_f64();
  keyspace.profile.eye_height_m = in.take_f64();
  constexpr std::size_t kAffineBytes = 3 * sizeof(double);
  const bool distorted = in.left() >= kAffineBytes;
  keyspace.profile.ranges =
      in.left() == (distorted ? kAffineBytes : 0) + 1 && in.take<std::uint8_t>() == 1;
  if (distorted) {
    keyspace.affine.a = in.take_f64();
    keyspace.affine.b = in.take_f64();
    keyspace.affine.k = in.take_f64();
  }
  if (in.failed() || in.left() != 0) return fail(ErrorCode::kDataLoss, "key: wrong length");
  if (Status valid = validate(keyspace.profile); !valid) {
    return fail(ErrorCode::kDataLoss, "key: " + valid.error().message);
  }
  return keyspace;
}

Fingerprint digest(const Keyspace& keyspace) {
  Hasher hasher;
  hasher.add_bytes(to_bytes(keyspace));
  return hasher.digest();
}

}  // namespace semview::cache

std::size_t std::hash<semview::cache::ViewKey>::operator()(
    const semview::cache::ViewKey& key) const noexcept {
  std::uint64_t keyspace = 0;  // a digest's bits are as good as random
  std::memcpy(&keyspace, key.keyspace.bytes.data(), sizeof(keyspace));
  return std::hash<semview::CellIndex>()(key.cell) ^ static_cast<std::size_t>(keyspace);
}
