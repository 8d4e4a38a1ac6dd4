// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/column_grid.hpp"

#include <algorithm>
#include <array>

namespace semview::raycast {
namespace {

bool look_alike(const ColumnProfile& a, const ColumnProfile& b) {
  return a.outside == b.outside && a.ground == b.ground && a.slabs == b.slabs;
}

/// The lowest id of a profile that looks like each.
std::vector<std::uint8_t> appearances(const std::vector<ColumnProfile>& profiles) {
  std::vector<std::uint8_t> ids(profiles.size());
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const auto first = std::ranges::find_if(
        profiles, [&](const ColumnProfile& profile) { return look_alike(profile, profiles[i]); });
    ids[i] = static_cast<std::uint8_t>(first - profiles.begin());
  }
  return ids;
}

double highest(const map::ColumnMap& plan) {
  double top_m = plan.ceiling ? plan.ceiling->height_m : plan.ground_height_m;
  for (const ColumnProfile& profile : plan.profiles) {
    for (const Slab& slab : profile.slabs) top_m = std::max(top_m, slab.z_max_m);
  }
  return top_m;
}

bool is_closed(const ColumnProfile& profile, double ground_m, double top_m) {
  double height_m = ground_m;
  for (const Slab& slab : profile.slabs) {
    if (slab.z_min_m > height_m) return false;
    height_m = std::max(height_m, slab.z_max_m);
  }
  return !profile.slabs.empty() && height_m >= top_m;
}

/// A cell with reach 1 for each profile, or 0 if it is closed.
std::array<std::uint16_t, 256> cells_of(const map::ColumnMap& plan, const ColumnGrid& grid) {
  const std::vector<std::uint8_t> appearance = appearances(plan.profiles);
  std::array<std::uint16_t, 256> cells{};
  for (std::size_t p = 0; p < plan.profiles.size(); ++p) {
    const int reach = is_closed(plan.profiles[p], grid.ground_m, grid.top_m) ? 0 : 1;
    cells[p] = static_cast<std::uint16_t>(appearance[p] << 8 | reach);
  }
  return cells;
}

/// Sets the reaches of one plane, from its far corner on: the square from a cell on is as large as
/// the smallest of those from its three neighbours ahead allows.
void measure_reaches(ColumnGrid& grid, bool falls_u, bool falls_v) {
  const std::ptrdiff_t across = falls_u ? -1 : 1;
  const std::ptrdiff_t up = falls_v ? -grid.stride() : grid.stride();
  std::uint16_t* plane = grid.cells.data() + static_cast<std::ptrdiff_t>(grid.plane_size()) *
                                                 ColumnGrid::plane(falls_u, falls_v);
  for (int i = 0; i < grid.rows; ++i) {
    const int v = falls_v ? 1 + i : grid.rows - i;
    for (int j = 0; j < grid.columns; ++j) {
      const int u = falls_u ? 1 + j : grid.columns - j;
      std::uint16_t* cell = plane + static_cast<std::ptrdiff_t>(v) * grid.stride() + u;
      if ((*cell & ColumnGrid::kReachMask) == 0) continue;
      int ahead = ColumnGrid::kReachMask - 1;
      for (const std::ptrdiff_t step : {across, up, across + up}) {
        // Neither the border nor a closed cell is part of the square: both have reach 0.
        const bool same = cell[step] >> 8 == *cell >> 8;
        ahead = std::min(ahead, same ? cell[step] & ColumnGrid::kReachMask : 0);
      }
      *cell = static_cast<std::uint16_t>((*cell & ~ColumnGrid::kReachMask) | (ahead + 1));
    }
  }
}

}  // namespace

ColumnGrid build_column_grid(const map::ColumnMap& plan) {
  ColumnGrid grid;
  grid.columns = plan.columns();
  grid.rows = plan.rows();
  grid.resolution_m = plan.resolution_m;
  grid.ground_m = plan.ground_height_m;
  grid.top_m = highest(plan);
  const std::array<std::uint16_t, 256> cell_of = cells_of(plan, grid);
  const auto plane_size = static_cast<std::size_t>(grid.plane_size());
  const auto stride = static_cast<std::size_t>(grid.stride());
  grid.cells.assign(ColumnGrid::kPlanes * plane_size + 1, 0);
  for (int v = 0; v < grid.rows; ++v) {
    for (int u = 0; u < grid.columns; ++u) {
      grid.cells[static_cast<std::size_t>(v + 1) * stride + static_cast<std::size_t>(u + 1)] =
          cell_of[plan.profile_of_pixel.at(grid.rows - 1 - v, u)];
    }
  }
  for (std::size_t plane = 1; plane < ColumnGrid::kPlanes; ++plane) {
    std::copy_n(grid.cells.begin(),
                plane_size,
                grid.cells.begin() + static_cast<std::ptrdiff_t>(plane * plane_size));
  }
  for (const bool falls_u : {false, true}) {
    for (const bool falls_v : {false, true}) measure_reaches(grid, falls_u, falls_v);
  }
  return grid;
}

}  // namespace semview::raycast
