// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/column_grid.hpp"

#include <algorithm>
#include <array>
#include <utility>

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

/// Slabs without a gap from the ground to the top: nothing behind is seen between the two, nothing
/// is above, and what goes below the ground in between never comes up again.
bool closed(const ColumnProfile& profile, double ground_m, double top_m) {
  double height_m = ground_m;
  for (const Slab& slab : profile.slabs) {
    if (slab.z_min_m > height_m) return false;
    height_m = std::max(height_m, slab.z_max_m);
  }
  return !profile.slabs.empty() && height_m >= top_m;
}

/// Chebyshev distances to the nearest cell of another profile, by two passes of a chamfer mask,
/// which is exact for this metric. The border is another profile.
class ReachField {
 public:
  ReachField(ColumnGrid& grid) : grid_(grid), stride_(grid.stride()) {}

  void measure() {
    for (int r = 1; r <= grid_.rows; ++r) {
      for (int c = 1; c <= grid_.columns; ++c) relax(r * stride_ + c, -1);
    }
    for (int r = grid_.rows; r >= 1; --r) {
      for (int c = grid_.columns; c >= 1; --c) relax(r * stride_ + c, 1);
    }
  }

 private:
  /// `way` -1 looks at the neighbours that a pass from below left has seen, 1 at the others.
  void relax(std::ptrdiff_t index, int way) {
    std::uint16_t& cell = grid_.cells[static_cast<std::size_t>(index)];
    int reach = way < 0 ? ColumnGrid::kReachMask : cell & ColumnGrid::kReachMask;
    for (const std::ptrdiff_t step : {stride_ - 1, stride_, stride_ + 1, 1}) {
      const std::uint16_t other = grid_.cells[static_cast<std::size_t>(index + way * step)];
      const int other_reach = other & ColumnGrid::kReachMask;
      const bool same = other >> 8 == cell >> 8 && other_reach != 0;
      reach = std::min(reach, same ? other_reach + 1 : 1);
    }
    cell = static_cast<std::uint16_t>((cell & ~ColumnGrid::kReachMask) | reach);
  }

  ColumnGrid& grid_;
  int stride_;
};

}  // namespace

ColumnGrid build_column_grid(const map::ColumnMap& plan) {
  ColumnGrid grid;
  grid.columns = plan.columns();
  grid.rows = plan.rows();
  grid.resolution_m = plan.resolution_m;
  grid.ground_m = plan.ground_height_m;
  grid.top_m = highest(plan);
  const std::vector<std::uint8_t> appearance = appearances(plan.profiles);
  std::array<std::uint16_t, 256> cell_of{};
  for (std::size_t p = 0; p < plan.profiles.size(); ++p) {
    const bool is_closed = closed(plan.profiles[p], grid.ground_m, grid.top_m);
    // Reach 1 until it is measured.
    cell_of[p] =
        static_cast<std::uint16_t>(appearance[p] << 8 | (is_closed ? ColumnGrid::kClosed : 0) | 1);
  }
  const auto stride = static_cast<std::size_t>(grid.stride());
  grid.cells.assign(stride * (static_cast<std::size_t>(grid.rows) + 2) + 1, 0);
  for (int v = 0; v < grid.rows; ++v) {
    for (int u = 0; u < grid.columns; ++u) {
      grid.cells[static_cast<std::size_t>(v + 1) * stride + static_cast<std::size_t>(u + 1)] =
          cell_of[plan.profile_of_pixel.at(grid.rows - 1 - v, u)];
    }
  }
  ReachField(grid).measure();
  return grid;
}

}  // namespace semview::raycast
