// SPDX-License-Identifier: Apache-2.0
#include "semview/simulation/world.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace semview::simulation {
namespace {

constexpr std::size_t kMaxProfiles = 256;
constexpr int kHeightSteps = 4;  // each way
constexpr double kFreeStanding_m = 0.3;
constexpr double kMaxFurniture_m2 = 6.0;

/// The pixels of the 4-connected part of one profile that holds `start`; marks them in `seen`.
std::vector<map::PixelIndex> part_of(const map::ColumnMap& plan,
                                     const map::PixelIndex& start,
                                     Image<std::uint8_t>& seen) {
  const std::uint8_t profile = plan.profile_of_pixel.at(start.row, start.column);
  std::vector<map::PixelIndex> part{start};
  seen.at(start.row, start.column) = 1;
  for (std::size_t k = 0; k < part.size(); ++k) {
    for (const auto& [dr, dc] :
         {std::pair(0, 1), std::pair(1, 0), std::pair(0, -1), std::pair(-1, 0)}) {
      const map::PixelIndex next{part[k].row + dr, part[k].column + dc};
      if (next.row < 0 || next.row >= plan.rows() || next.column < 0 ||
          next.column >= plan.columns() || seen.at(next.row, next.column) != 0 ||
          plan.profile_of_pixel.at(next.row, next.column) != profile) {
        continue;
      }
      seen.at(next.row, next.column) = 1;
      part.push_back(next);
    }
  }
  return part;
}

/// Where the highest column ends: the ceiling of a plan without one.
double top_of(const map::ColumnMap& plan) {
  if (plan.ceiling) return plan.ceiling->height_m;
  double top_m = plan.ground_height_m;
  for (const ColumnProfile& profile : plan.profiles) {
    if (!profile.slabs.empty()) top_m = std::max(top_m, profile.slabs.back().z_max_m);
  }
  return top_m;
}

/// Faces between ground and top, moved by `shift_m`, less where they would come too near to either.
ColumnProfile with_moved_faces(ColumnProfile profile,
                               double shift_m,
                               double ground_m,
                               double top_m) {
  const auto move = [&](double z_m) {
    if (z_m <= ground_m || z_m >= top_m) return z_m;
    // Keeps the order of faces: at most a third of the way to ground or top.
    const double room_m = std::min(z_m - ground_m, top_m - z_m) / 3.0;
    return z_m + std::clamp(shift_m, -room_m, room_m);
  };
  double below_m = ground_m;
  for (Slab& slab : profile.slabs) {
    slab.z_min_m = std::max(move(slab.z_min_m), below_m);
    slab.z_max_m = std::max(move(slab.z_max_m), slab.z_min_m);
    below_m = slab.z_max_m;
  }
  std::erase_if(profile.slabs, [](const Slab& slab) { return slab.z_max_m <= slab.z_min_m; });
  return profile;
}

class Variation {
 public:
  Variation(const map::SemanticMap& drawn, const WorldConfig& config, Rng& rng)
      : drawn_(drawn), config_(config), rng_(rng) {
    world_.plan = *drawn.columns();
    top_m_ = top_of(world_.plan);
    map_names_movables_ = std::any_of(drawn.class_details.begin(),
                                      drawn.class_details.end(),
                                      [](const map::MapClass& c) { return c.movable > 0.0; });
  }

  World run() {
    const map::ColumnMap& before = *drawn_.columns();
    Image<std::uint8_t> seen(before.rows(), before.columns());
    for (int row = 0; row < before.rows(); ++row) {
      for (int column = 0; column < before.columns(); ++column) {
        if (seen.at(row, column) != 0 || before.profile(row, column).slabs.empty()) continue;
        vary(part_of(before, {row, column}, seen), before.profile_of_pixel.at(row, column));
      }
    }
    return std::move(world_);
  }

 private:
  void vary(const std::vector<map::PixelIndex>& part, std::uint8_t profile) {
    const ColumnProfile& column = drawn_.columns()->profiles[profile];
    const double ground_m = world_.plan.ground_height_m;
    const bool has_face = std::any_of(column.slabs.begin(), column.slabs.end(), [&](const Slab& s) {
      return s.z_min_m > ground_m || s.z_max_m < top_m_;
    });
    if (!has_face) return;
    ++world_.objects;
    // Every object takes the same numbers from the stream, whatever becomes of it.
    const int step = static_cast<int>(rng_.below(2 * kHeightSteps + 1)) - kHeightSteps;
    const bool taken = rng_.uniform() < config_.missing_share;
    const bool furniture = is_furniture(column, part.size());
    world_.furniture += furniture ? 1 : 0;
    std::optional<std::uint8_t> variant;
    if (furniture && taken) {
      variant = variant_of(profile, std::nullopt);
      world_.missing += variant ? 1 : 0;
    } else if (step != 0) {
      variant = variant_of(profile, step);
    }
    if (!variant) return;
    for (const map::PixelIndex& pixel : part) {
      world_.plan.profile_of_pixel.at(pixel.row, pixel.column) = *variant;
    }
  }

  bool is_furniture(const ColumnProfile& column, std::size_t pixels) const {
    if (column.passable) return false;
    if (map_names_movables_) {
      return std::any_of(column.slabs.begin(), column.slabs.end(), [&](const Slab& slab) {
        return slab.label <= drawn_.class_details.size() &&
               drawn_.class_details[slab.label - std::size_t{1}].movable > 0.0;
      });
    }
    const double area_m2 =
        static_cast<double>(pixels) * world_.plan.resolution_m * world_.plan.resolution_m;
    return column.slabs.back().z_max_m < top_m_ - kFreeStanding_m && area_m2 <= kMaxFurniture_m2;
  }

  /// The profile moved by `step`, or taken away; none if the plan has no room for one more.
  std::optional<std::uint8_t> variant_of(std::uint8_t profile, std::optional<int> step) {
    const auto [place, is_new] = variants_.try_emplace({profile, step});
    if (!is_new) return place->second;
    if (world_.plan.profiles.size() >= kMaxProfiles) return std::nullopt;
    ColumnProfile column = drawn_.columns()->profiles[profile];
    if (step) {
      column = with_moved_faces(std::move(column),
                                *step * config_.height_error_m / kHeightSteps,
                                world_.plan.ground_height_m,
                                top_m_);
    } else {
      column.slabs.clear();
    }
    place->second = static_cast<std::uint8_t>(world_.plan.profiles.size());
    world_.plan.profiles.push_back(std::move(column));
    return place->second;
  }

  const map::SemanticMap& drawn_;
  const WorldConfig& config_;
  Rng& rng_;
  World world_;
  double top_m_ = 0.0;
  bool map_names_movables_ = false;
  std::map<std::pair<std::uint8_t, std::optional<int>>, std::optional<std::uint8_t>> variants_;
};

}  // namespace

World vary_plan(const map::SemanticMap& drawn, const WorldConfig& config, Rng& rng) {
  return Variation(drawn, config, rng).run();
}

int open_doors(map::ColumnMap& plan,
               std::span<const Point2> line,
               double reach_m,
               double eye_height_m) {
  const double eye_z_m = plan.ground_height_m + eye_height_m;
  Image<std::uint8_t> seen(plan.rows(), plan.columns());
  std::map<std::uint8_t, std::uint8_t> open_of;
  int opened = 0;
  const int reach_px = static_cast<int>(std::ceil(reach_m / plan.resolution_m));
  for (const Point2& point : line) {
    const auto center = plan.pixel_at(point.x_m, point.y_m);
    if (!center) continue;
    for (int row = std::max(0, center->row - reach_px);
         row <= std::min(plan.rows() - 1, center->row + reach_px);
         ++row) {
      for (int column = std::max(0, center->column - reach_px);
           column <= std::min(plan.columns() - 1, center->column + reach_px);
           ++column) {
        if (seen.at(row, column) != 0) continue;
        const std::uint8_t closed = plan.profile_of_pixel.at(row, column);
        const ColumnProfile profile = plan.profiles[closed];
        if (!profile.passable || !profile.reaches_into(plan.ground_height_m, eye_z_m)) continue;
        if (open_of.count(closed) == 0) {
          if (plan.profiles.size() >= kMaxProfiles) continue;
          ColumnProfile open = profile;
          std::erase_if(open.slabs, [&](const Slab& slab) { return slab.z_min_m < eye_z_m; });
          open_of[closed] = static_cast<std::uint8_t>(plan.profiles.size());
          plan.profiles.push_back(std::move(open));
        }
        const auto part = part_of(plan, {row, column}, seen);
        for (const map::PixelIndex& pixel : part) {
          plan.profile_of_pixel.at(pixel.row, pixel.column) = open_of[closed];
        }
        ++opened;
      }
    }
  }
  return opened;
}

}  // namespace semview::simulation
