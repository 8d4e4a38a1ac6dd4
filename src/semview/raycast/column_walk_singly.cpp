// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>

#include "semview/raycast/column_walk.hpp"

namespace semview::raycast {
namespace {

/// One axis of one ray.
struct RayAxis {
  float slope;
  float inverse;
  float behind;
  bool falls;
  std::int32_t eye_cell;
  std::int32_t cell;

  RayAxis(const EyeOnAxis& eye, float signed_slope, std::int32_t begin)
      : slope(std::abs(signed_slope)),
        inverse(1.0F / std::max(slope, kLeastSlope)),
        falls(signed_slope < 0.0F),
        cell(begin) {
    behind = eye.behind[falls ? 1 : 0];
    eye_cell = eye.cell[falls ? 1 : 0];
  }

  /// Counted with the border.
  std::int64_t place() const { return eye_cell + 1 + (falls ? -cell : cell); }
  float leaves(std::int32_t end) const { return (static_cast<float>(end) - behind) * inverse; }
  std::int32_t at(float distance_m, std::int32_t end) const {
    const float there = distance_m * slope + (behind - 0.5F);
    const auto rounded =
        std::bit_cast<std::int32_t>(there + kRounding) - std::bit_cast<std::int32_t>(kRounding);
    return std::max(std::min(rounded, end - 1), cell);
  }
};

void walk_ray(const ColumnGrid& grid,
              const ColumnRays& rays,
              std::size_t ray,
              std::vector<Crossing>& crossings) {
  RayAxis u(rays.u, rays.slope_u[ray], rays.begin_u[ray]);
  RayAxis v(rays.v, rays.slope_v[ray], rays.begin_v[ray]);
  const std::uint16_t* plane =
      grid.cells.data() + std::ptrdiff_t{ColumnGrid::plane(u.falls, v.falls)} * grid.plane_size();
  float distance_m = rays.begins_at_m[ray];
  if (distance_m > 0.0F) crossings.push_back({});
  for (std::uint32_t profile = ~0U;;) {
    const std::uint32_t cell = plane[v.place() * grid.stride() + u.place()];
    const std::uint32_t here = (cell & kProfileBits) >> 8;
    if (here != profile) crossings.push_back({distance_m, here});
    profile = here;
    auto reach = static_cast<std::int32_t>(cell & ColumnGrid::kReachMask);
    if (rays.through_closed && here != 0) reach = std::max(reach, 1);
    if (reach == 0) return;
    const std::int32_t end_u = u.cell + reach;
    const std::int32_t end_v = v.cell + reach;
    const float leaves_u = u.leaves(end_u);
    const float leaves_v = v.leaves(end_v);
    distance_m = std::min(leaves_u, leaves_v);
    if (leaves_u <= leaves_v) {
      u.cell = end_u;
      v.cell = v.at(distance_m, end_v);
    } else {
      u.cell = u.at(distance_m, end_u);
      v.cell = end_v;
    }
  }
}

}  // namespace

void walk_columns_singly(const ColumnGrid& grid, const ColumnRays& rays, Crossings& crossings) {
  crossings.clear(rays);
  for (std::size_t ray = 0; ray < rays.count; ++ray) {
    crossings.begin[ray] = static_cast<std::uint32_t>(crossings.all.size());
    walk_ray(grid, rays, ray, crossings.all);
    crossings.end[ray] = static_cast<std::uint32_t>(crossings.all.size());
  }
}

}  // namespace semview::raycast
