// SPDX-License-Identifier: Apache-2.0
/// Where the rays of a panorama's columns cross from one profile to another. Internal to this
/// module.
///
/// All rays of a column stand over one line of the plan. Along it the walk leaps from square to
/// square: the cells within a cell's reach have its profile, so the ray goes on to where it leaves
/// them. With u, v the plan's axes in cells, and counting along each in the ray's own direction
/// from the eye's cell,
///
///     distance of the far edge of cell i    (i + 1 - behind) / slope
///     cell at a distance t                  round(t · slope + behind - 1/2)
///
/// where `behind` is the part of the eye's cell that lies behind the eye. Nothing grows with the
/// eye's coordinates, so that float errs by some 1e-7 of the distance.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "semview/raycast/column_grid.hpp"

namespace semview::raycast {

/// Where an eye stands along one axis of the grid, for rays of [0] rising and [1] falling `slope`;
/// the two differ where it stands on an edge.
struct EyeOnAxis {
  std::array<float, 2> behind = {};
  std::array<std::int32_t, 2> cell = {};  // counted without the border
};

/// Rays along which to walk. The arrays hold one entry a ray and, behind them, as many valid ones
/// as fill up a multiple of `kPadding`.
struct ColumnRays {
  static constexpr std::size_t kPadding = 32;

  EyeOnAxis u;
  EyeOnAxis v;
  bool through_closed = false;  // a walk ends at the border only
  std::size_t count = 0;
  std::vector<float> slope_u, slope_v;  // cells a metre of range, not both 0
  /// Cells and distance from the eye's cell at which the walk begins: all 0, or where an eye past
  /// the grid meets it; on the border if it never does.
  std::vector<std::int32_t> begin_u, begin_v;
  std::vector<float> begins_at_m;
};

/// From here on the ray is over another profile.
struct Crossing {
  float distance_m = 0.0F;
  std::uint32_t profile = 0;

  bool operator==(const Crossing&) const = default;
};

/// The crossings of ray i are [begin[i], end[i]) of `all`; its first is at distance 0. Distances do
/// not decrease by more than rounding does; the last crossing is where the walk ended.
struct Crossings {
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> end;
  std::vector<Crossing> all;
  bool ends_closed = false;  // a walk that ended over slabs ended at a closed profile

  void clear(const ColumnRays& rays) {
    begin.resize(rays.count);
    end.resize(rays.count);
    all.clear();
    ends_closed = !rays.through_closed;
  }
  std::span<const Crossing> of(std::size_t ray) const {
    return std::span(all).subspan(begin[ray], end[ray] - begin[ray]);
  }
};

// A ray along an axis never leaves a cell across the other; the distance stays finite.
inline constexpr float kLeastSlope = 1e-30F;
// Added to a number below 2^22, it leaves that, rounded to a whole one, in the lowest bits.
inline constexpr float kRounding = 12582912.0F;
// Of a cell.
inline constexpr std::uint32_t kProfileBits = 0xFF00;

/// @param crossings  what it held before is lost, its memory is used again.
/// @threads Safe to call from several threads on one grid.
void walk_columns(const ColumnGrid& grid, const ColumnRays& rays, Crossings& crossings);

/// The same bits, cell by cell and ray by ray: the twin that tests compare with.
void walk_columns_singly(const ColumnGrid& grid, const ColumnRays& rays, Crossings& crossings);

}  // namespace semview::raycast
