// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/engine_check.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace semview::raycast {
namespace {

constexpr double kTie_rad = 1e-4;
constexpr float kSameRange_m = 0.01F;
constexpr float kSameRange = 0.01F;  // of the range, for a ray that was turned

using Cells = std::set<CellIndex>;

/// One cell near a place where two profiles meet, for each pair that does so.
class PairCells {
 public:
  PairCells(const map::ColumnMap& plan, const map::CellGrid& grid)
      : plan_(plan), grid_(grid), found_(plan.profiles.size() * plan.profiles.size(), false) {}

  Cells find() {
    for (int r = 0; r < plan_.rows(); ++r) {
      for (int c = 0; c < plan_.columns(); ++c) {
        if (c + 1 < plan_.columns()) look({r, c}, {r, c + 1});
        if (r + 1 < plan_.rows()) look({r, c}, {r + 1, c});
      }
    }
    return std::move(cells_);
  }

 private:
  void look(const map::PixelIndex& one, const map::PixelIndex& other) {
    const std::uint8_t a = plan_.profile_of_pixel.at(one.row, one.column);
    const std::uint8_t b = plan_.profile_of_pixel.at(other.row, other.column);
    if (a == b) return;
    const std::size_t pair = std::min(a, b) * plan_.profiles.size() + std::max(a, b);
    if (found_[pair]) return;
    const Eigen::Vector2d place = plan_.pixel_center(one);
    const std::optional<CellIndex> cell = PoseGrid::cell(place.x(), place.y());
    if (!cell || (pair == last_pair_ && *cell == last_cell_)) return;
    last_pair_ = pair;
    last_cell_ = *cell;
    const std::optional<CellIndex> eye = grid_.view_cell(*cell);
    if (!eye) return;
    found_[pair] = true;
    cells_.insert(*eye);
  }

  const map::ColumnMap& plan_;
  const map::CellGrid& grid_;
  std::vector<bool> found_;
  std::size_t last_pair_ = 0;  // looked for last, in vain: its next pixels are often in one cell
  CellIndex last_cell_;
  Cells cells_;
};

/// The middle cell, in the order of the search, of each room.
Cells room_cells(const map::ColumnMap& plan, const map::CellGrid& grid) {
  const auto is_room = [&](const CellIndex& cell) {
    if (!grid.is_free(cell) || !grid.has_eye(cell)) return false;
    const Pose2 center = PoseGrid::center(cell);
    const ColumnProfile* profile = plan.at(center.x_m, center.y_m);
    return profile != nullptr && !profile->passable;
  };
  const auto place = [&](const CellIndex& cell) {
    return static_cast<std::size_t>(cell.iy - grid.minimum().iy) *
               static_cast<std::size_t>(grid.columns()) +
           static_cast<std::size_t>(cell.ix - grid.minimum().ix);
  };
  Cells cells;
  std::vector<bool> seen(
      static_cast<std::size_t>(grid.columns()) * static_cast<std::size_t>(grid.rows()), false);
  for (const CellIndex& start : grid.free_cells()) {
    if (seen[place(start)] || !is_room(start)) continue;
    seen[place(start)] = true;
    std::vector<CellIndex> room{start};
    for (std::size_t next = 0; next < room.size(); ++next) {
      const CellIndex from = room[next];
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const CellIndex to{from.ix + dx, from.iy + dy};
        if (!grid.can_step(from, to) || seen[place(to)] || !is_room(to)) continue;
        seen[place(to)] = true;
        room.push_back(to);
      }
    }
    if (room.size() >= kSmallestRoom_cells) cells.insert(room[room.size() / 2]);
  }
  return cells;
}

/// What one ray of an engine meets.
struct Seen {
  ClassId label;
  float range_m;
};

Seen cast_one(const Engine& engine, PanoramaRequest request, double azimuth, double elevation) {
  request.map_from_robot.yaw_rad = azimuth;
  request.camera = {1, 1, elevation - 1e-9, elevation + 1e-9};
  const Panorama pixel = engine.panorama(request);
  return {pixel.labels.at(0, 0), pixel.ranges_m.at(0, 0)};
}

bool near_ranges(float one_m, float other_m, float tolerance_m) {
  return one_m == other_m || std::abs(one_m - other_m) <= tolerance_m;
}

bool is_tie(const Engine& reference,
            const PanoramaRequest& request,
            int row,
            int column,
            const Seen& seen) {
  const double azimuth = request.camera.azimuth_rad(column);
  const double elevation = request.camera.elevation_rad(row);
  const float tolerance_m = std::max(kSameRange_m, kSameRange * seen.range_m);
  for (const double turn : {-kTie_rad, 0.0, kTie_rad}) {
    for (const double tilt : {-kTie_rad, 0.0, kTie_rad}) {
      const Seen other = cast_one(reference, request, azimuth + turn, elevation + tilt);
      if (other.label == seen.label && near_ranges(other.range_m, seen.range_m, tolerance_m)) {
        return true;
      }
    }
  }
  return false;
}

std::optional<Disagreement> compare_views(const Engine& engine,
                                          const Engine& reference,
                                          const CellIndex& cell,
                                          const PanoramaRequest& request) {
  const Panorama expected = reference.panorama(request);
  const Panorama seen = engine.panorama(request);
  // What is stored and scored, without ranges and with them: paths of their own through an engine.
  const LabelImage labels = engine.column_view(request, false).to_labels();
  const ColumnView view = engine.column_view(request, true);
  const Panorama rebuilt{view.to_labels(), view.to_ranges(request.camera)};
  for (int r = 0; r < request.camera.rows; ++r) {
    for (int c = 0; c < request.camera.columns; ++c) {
      const Seen there{expected.labels.at(r, c), expected.ranges_m.at(r, c)};
      const float range_m = seen.ranges_m.at(r, c);
      for (const Seen& here : {Seen{labels.at(r, c), range_m},
                               Seen{seen.labels.at(r, c), range_m},
                               Seen{rebuilt.labels.at(r, c), rebuilt.ranges_m.at(r, c)}}) {
        const bool same =
            here.label == there.label && near_ranges(here.range_m, there.range_m, kSameRange_m);
        if (same || is_tie(reference, request, r, c, here)) continue;
        return Disagreement{cell, r, c, here.label, there.label, here.range_m, there.range_m};
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<CellIndex> cells_to_check(const map::ColumnMap& plan, const map::CellGrid& cells) {
  Cells chosen = PairCells(plan, cells).find();
  chosen.merge(room_cells(plan, cells));
  std::vector<CellIndex> eyes = cells.free_cells();
  std::erase_if(eyes, [&](const CellIndex& cell) { return !cells.has_eye(cell); });
  const std::size_t missing = chosen.size() < kCheckedCells ? kCheckedCells - chosen.size() : 0;
  for (std::size_t i = 0; i < std::min(missing, eyes.size()); ++i) {
    chosen.insert(eyes[(2 * i + 1) * eyes.size() / (2 * missing)]);
  }
  for (std::size_t i = 0; i < eyes.size() && chosen.size() < kCheckedCells; ++i) {
    chosen.insert(eyes[i]);  // where some of the others were chosen already
  }
  return {chosen.begin(), chosen.end()};
}

std::optional<Disagreement> find_disagreement(const Engine& engine,
                                              const Engine& reference,
                                              std::span<const CellIndex> cells,
                                              const ViewProfile& profile,
                                              double ground_height_m,
                                              ThreadPool& pool) {
  constexpr int kColumns = 120, kMostRows = 90;
  PanoramaCamera camera = profile.camera;
  camera.columns = kColumns;
  camera.rows = std::min(camera.rows, kMostRows);
  std::vector<std::optional<Disagreement>> found(cells.size());
  pool.parallel_for(cells.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const PanoramaRequest request{
          PoseGrid::center(cells[i]), ground_height_m + profile.eye_height_m, camera, {}};
      found[i] = compare_views(engine, reference, cells[i], request);
    }
  });
  const auto first = std::ranges::find_if(
      found, [](const auto& disagreement) { return disagreement.has_value(); });
  return first == found.end() ? std::nullopt : *first;
}

}  // namespace semview::raycast
