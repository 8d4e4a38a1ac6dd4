// SPDX-License-Identifier: Apache-2.0
/// Casts the rays of an image: the loops that all renderers share. Internal to this module.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "semview/raycast/ray_caster.hpp"

namespace semview::raycast {

/// Pixels that are cast together: neighbours, so that their rays meet the same boxes.
inline constexpr int kTileRows = 4;
inline constexpr int kTileColumns = 4;
inline constexpr int kLanes = 16;
static_assert(kTileRows * kTileColumns == kLanes);

/// Rows and columns of a tile's pixels; where the tile reaches over the image, its last ones again.
struct TilePlace {
  std::array<int, kTileRows> rows;
  std::array<int, kTileColumns> columns;
};

/// Directions of a tile's rays, row by row.
struct alignas(64) TileDirections {
  std::array<float, kLanes> x, y, z;
};

/// Packets of rays from one eye, one after the other in the same memory.
class RayPacket {
 public:
  explicit RayPacket(const RayCaster& caster) : caster_(caster) {
    for (int lane = 0; lane < kLanes; ++lane) {
      packet_.ray.tnear[lane] = 0.0F;
      packet_.ray.time[lane] = 0.0F;
      packet_.ray.mask[lane] = ~0U;
      packet_.ray.id[lane] = 0;
      packet_.ray.flags[lane] = 0;
      packet_.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
  }

  /// The same hits as `RayCaster::cast` but for `back_face`, which is not told.
  void cast(const TileDirections& d) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      packet_.ray.org_x[lane] = caster_.start_x(d.x[lane]);
      packet_.ray.org_y[lane] = caster_.start_y(d.y[lane]);
      packet_.ray.org_z[lane] = caster_.start_z(d.z[lane]);
      packet_.ray.dir_x[lane] = d.x[lane];
      packet_.ray.dir_y[lane] = d.y[lane];
      packet_.ray.dir_z[lane] = d.z[lane];
      packet_.ray.tfar[lane] = std::numeric_limits<float>::infinity();
      packet_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    }
    alignas(64) static constexpr std::array<int, kLanes> kAll{
        -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
    intersect_coherent(caster_.scene().scene, kAll.data(), packet_);
  }

  RayHit hit(int lane) const {
    const float start_to_hit = packet_.ray.tfar[lane];
    if (start_to_hit <= 2.0F * RayCaster::kTouch) return touched(lane);
    if (packet_.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) return {};
    const unsigned triangle = packet_.hit.primID[lane];
    return {caster_.scene().labels[triangle], start_to_hit - RayCaster::kTouch, false, triangle};
  }

 private:
  /// Of a surface that the eye touches: a back face is passed through, which a single ray does.
  RayHit touched(int lane) const {
    const RayDirection d{packet_.ray.dir_x[lane], packet_.ray.dir_y[lane], packet_.ray.dir_z[lane]};
    const bool facing_away =
        d.x * packet_.hit.Ng_x[lane] + d.y * packet_.hit.Ng_y[lane] + d.z * packet_.hit.Ng_z[lane] >
        0.0F;
    if (facing_away) return caster_.cast(d);
    const unsigned triangle = packet_.hit.primID[lane];
    return {caster_.scene().labels[triangle],
            std::max(0.0F, packet_.ray.tfar[lane] - RayCaster::kTouch),
            false,
            triangle};
  }

  const RayCaster& caster_;
  alignas(64) RTCRayHit16 packet_;
};

/// Calls `store(row, column, hit)` for every pixel of a rows × columns image.
/// `rays.tile(place, directions)` gives the rays of a tile.
template <typename Rays, typename Store>
void cast_tiles(
    const RayCaster& caster, int rows, int columns, const Rays& rays, const Store& store) {
  const DenormalsOff denormals_off;
  RayPacket packet(caster);
  TilePlace place;
  TileDirections directions;
  for (int top = 0; top < rows; top += kTileRows) {
    const int tile_rows = std::min(kTileRows, rows - top);
    for (int i = 0; i < kTileRows; ++i) {
      place.rows[static_cast<std::size_t>(i)] = std::min(top + i, rows - 1);
    }
    for (int left = 0; left < columns; left += kTileColumns) {
      const int tile_columns = std::min(kTileColumns, columns - left);
      for (int i = 0; i < kTileColumns; ++i) {
        place.columns[static_cast<std::size_t>(i)] = std::min(left + i, columns - 1);
      }
      rays.tile(place, directions);
      packet.cast(directions);
      for (int i = 0; i < tile_rows; ++i) {
        for (int k = 0; k < tile_columns; ++k) {
          store(top + i, left + k, packet.hit(i * kTileColumns + k));
        }
      }
    }
  }
}

/// The same, ray by ray; `rays(row, column)` gives a pixel's ray.
template <typename Rays, typename Store>
void cast_singly(
    const RayCaster& caster, int rows, int columns, const Rays& rays, const Store& store) {
  const DenormalsOff denormals_off;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      store(row, column, caster.cast(rays(row, column)));
    }
  }
}

}  // namespace semview::raycast
