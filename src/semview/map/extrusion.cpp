// SPDX-License-Identifier: Apache-2.0
#include "semview/map/extrusion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "semview/map/column_map.hpp"

namespace semview::map {
namespace {

// Heights are compared as the floats that become vertices: slabs that differ by less touch.
struct Solid {
  float low_m = 0.0F;
  float high_m = 0.0F;
  ClassId label = kNoHit;

  bool operator==(const Solid&) const = default;
};

/// A horizontal face over a whole pixel.
struct Level {
  float z_m = 0.0F;
  bool faces_up = false;
  ClassId label = kNoHit;

  bool operator<(const Level& other) const {
    return std::tie(z_m, faces_up, label) < std::tie(other.z_m, other.faces_up, other.label);
  }
};

/// What cuts every column.
struct Cuts {
  float ground_m = 0.0F;
  float ceiling_m = 0.0F;  ///< +∞: open top
};

Cuts cuts_of(const ColumnMap& map) {
  return {static_cast<float>(map.ground_height_m),
          map.ceiling ? static_cast<float>(map.ceiling->height_m)
                      : std::numeric_limits<float>::infinity()};
}

std::vector<Solid> solids_of(const ColumnProfile& profile, const Cuts& cuts) {
  std::vector<Solid> solids;
  if (profile.outside) return solids;
  for (const Slab& slab : profile.slabs) {
    const Solid solid{std::max(static_cast<float>(slab.z_min_m), cuts.ground_m),
                      std::min(static_cast<float>(slab.z_max_m), cuts.ceiling_m),
                      slab.label};
    if (solid.low_m >= solid.high_m) continue;
    if (!solids.empty() && solids.back().label == solid.label &&
        solids.back().high_m == solid.low_m) {
      solids.back().high_m = solid.high_m;
    } else {
      solids.push_back(solid);
    }
  }
  return solids;
}

std::vector<Level> levels_of(const ColumnProfile& profile,
                             const std::vector<Solid>& solids,
                             const Cuts& cuts,
                             ClassId ceiling_label) {
  std::vector<Level> levels;
  if (profile.outside) return levels;
  float below_m = cuts.ground_m;  // top of what lies under the next solid
  ClassId below_label = profile.ground;
  for (const Solid& solid : solids) {
    if (below_m < solid.low_m) {
      levels.push_back({below_m, true, below_label});
      levels.push_back({solid.low_m, false, solid.label});
    }
    below_m = solid.high_m;
    below_label = solid.label;
  }
  if (below_m < cuts.ceiling_m) {
    levels.push_back({below_m, true, below_label});
    if (std::isfinite(cuts.ceiling_m)) levels.push_back({cuts.ceiling_m, false, ceiling_label});
  }
  return levels;
}

/// The parts of `solids` that are not inside `cover`.
std::vector<Solid> exposed(std::span<const Solid> solids, std::span<const Solid> cover) {
  std::vector<Solid> parts;
  for (const Solid& solid : solids) {
    float low_m = solid.low_m;
    for (const Solid& covering : cover) {
      if (covering.high_m <= low_m || covering.low_m >= solid.high_m) continue;
      if (covering.low_m > low_m) parts.push_back({low_m, covering.low_m, solid.label});
      low_m = covering.high_m;
    }
    if (low_m < solid.high_m) parts.push_back({low_m, solid.high_m, solid.label});
  }
  return parts;
}

/// A corner of pixels: column edge `i` (0 = left edge), row edge `j` (0 = top edge).
struct Corner {
  int i = 0;
  int j = 0;
  float z_m = 0.0F;
};

class MeshBuilder {
 public:
  explicit MeshBuilder(const ColumnMap& map) : map_(map) {}

  /// Corners counter-clockwise as seen from free space, the other way round if `turned`.
  void add_quad(const std::array<Corner, 4>& corners, bool turned, ClassId label) {
    std::array<std::uint32_t, 4> v{};
    for (std::size_t k = 0; k < 4; ++k) v[k] = vertex(corners[turned ? 3 - k : k]);
    mesh_.triangles.push_back({v[0], v[1], v[2]});
    mesh_.triangles.push_back({v[0], v[2], v[3]});
    mesh_.labels.insert(mesh_.labels.end(), 2, label);
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t vertex(const Corner& corner) {
    const auto level = static_cast<std::uint64_t>(
        level_of_.try_emplace(corner.z_m, level_of_.size()).first->second);
    const std::uint64_t key = (level << 48U) | (static_cast<std::uint64_t>(corner.j) << 24U) |
                              static_cast<std::uint64_t>(corner.i);
    const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
    const auto [place, is_new] = vertex_of_.try_emplace(key, next);
    if (is_new) {
      const Eigen::Vector2d point = map_.map_from_plan(
          corner.i * map_.resolution_m, (map_.rows() - corner.j) * map_.resolution_m);
      mesh_.vertices.emplace_back(
          static_cast<float>(point.x()), static_cast<float>(point.y()), corner.z_m);
    }
    return place->second;
  }

  const ColumnMap& map_;
  std::map<float, std::size_t> level_of_;
  std::unordered_map<std::uint64_t, std::uint32_t> vertex_of_;
  TriangleMesh mesh_;
};

/// Covers the ones of `pending` with rectangles, largest first to the right, then downwards, and
/// clears them.
template <typename Emit>
void cover_with_rectangles(Image<std::uint8_t>& pending, const Emit& emit) {
  for (int top = 0; top < pending.rows(); ++top) {
    for (int left = 0; left < pending.columns(); ++left) {
      if (pending.at(top, left) == 0) continue;
      int right = left;
      while (right < pending.columns() && pending.at(top, right) != 0) ++right;
      const auto whole_row_pending = [&](int row) {
        const auto part = pending.row(row).subspan(static_cast<std::size_t>(left),
                                                   static_cast<std::size_t>(right - left));
        return std::all_of(part.begin(), part.end(), [](std::uint8_t p) { return p != 0; });
      };
      int bottom = top + 1;
      while (bottom < pending.rows() && whole_row_pending(bottom)) ++bottom;
      for (int row = top; row < bottom; ++row) {
        for (int column = left; column < right; ++column) pending.at(row, column) = 0;
      }
      emit(top, bottom, left, right);
    }
  }
}

class Extruder {
 public:
  explicit Extruder(const ColumnMap& map) : map_(map), builder_(map) {
    const Cuts cuts = cuts_of(map);
    const ClassId ceiling_label = map.ceiling ? map.ceiling->label : kNoHit;
    for (std::size_t p = 0; p < map.profiles.size(); ++p) {
      solids_.push_back(solids_of(map.profiles[p], cuts));
      for (const Level& level : levels_of(map.profiles[p], solids_[p], cuts, ceiling_label)) {
        auto& has_level = profiles_of_level_[level];
        has_level.resize(map.profiles.size(), 0);
        has_level[p] = 1;
      }
    }
    solids_.emplace_back();  // beyond the image's border: nothing
  }

  TriangleMesh extrude() {
    if (map_.profile_of_pixel.empty()) return {};
    for (const auto& [level, has_level] : profiles_of_level_) add_level(level, has_level);
    const int rows = map_.rows();
    const int columns = map_.columns();
    for (int i = 0; i <= columns; ++i) {
      add_line(
          rows,
          [&](int row) { return std::pair(profile(row, i - 1), profile(row, i)); },
          [&](int from, int to, const Solid& face, bool toward_second) {
            builder_.add_quad({Corner{i, to, face.low_m},
                               Corner{i, from, face.low_m},
                               Corner{i, from, face.high_m},
                               Corner{i, to, face.high_m}},
                              !toward_second,
                              face.label);
          });
    }
    for (int j = 0; j <= rows; ++j) {
      add_line(
          columns,
          [&](int column) { return std::pair(profile(j - 1, column), profile(j, column)); },
          [&](int from, int to, const Solid& face, bool toward_second) {
            builder_.add_quad({Corner{from, j, face.low_m},
                               Corner{to, j, face.low_m},
                               Corner{to, j, face.high_m},
                               Corner{from, j, face.high_m}},
                              !toward_second,
                              face.label);
          });
    }
    return builder_.take();
  }

 private:
  std::size_t profile(int row, int column) const {
    const auto& image = map_.profile_of_pixel;
    const bool inside = row >= 0 && row < image.rows() && column >= 0 && column < image.columns();
    return inside ? image.at(row, column) : map_.profiles.size();
  }

  void add_level(const Level& level, const std::vector<std::uint8_t>& has_level) {
    Image<std::uint8_t> pending(map_.rows(), map_.columns());
    std::transform(map_.profile_of_pixel.pixels().begin(),
                   map_.profile_of_pixel.pixels().end(),
                   pending.pixels().begin(),
                   [&](std::uint8_t p) { return has_level[p]; });
    cover_with_rectangles(pending, [&](int top, int bottom, int left, int right) {
      builder_.add_quad({Corner{left, bottom, level.z_m},
                         Corner{right, bottom, level.z_m},
                         Corner{right, top, level.z_m},
                         Corner{left, top, level.z_m}},
                        !level.faces_up,
                        level.label);
    });
  }

  /// The upright faces between the pixels on both sides of a line, runs of equal ones merged.
  /// `pair_at(k)` gives the profiles on the first (left, upper) and second side.
  template <typename PairAt, typename Emit>
  void add_line(int length, const PairAt& pair_at, const Emit& emit) {
    for (const bool toward_second : {true, false}) {
      const std::vector<Solid> none;
      const std::vector<Solid>* current = &none;
      std::vector<std::pair<Solid, int>> open;  // face and where it began
      for (int k = 0; k <= length; ++k) {
        const std::vector<Solid>* faces = &none;
        if (k < length) {
          const auto [first, second] = pair_at(k);
          faces = toward_second ? &faces_of(first, second) : &faces_of(second, first);
        }
        if (faces == current) continue;
        const auto ends = [&](const std::pair<Solid, int>& run) {
          return std::find(faces->begin(), faces->end(), run.first) == faces->end();
        };
        for (const auto& run : open) {
          if (ends(run)) emit(run.second, k, run.first, toward_second);
        }
        std::erase_if(open, ends);
        for (const Solid& face : *faces) {
          const auto is_open = [&](const auto& run) { return run.first == face; };
          if (std::none_of(open.begin(), open.end(), is_open)) open.emplace_back(face, k);
        }
        current = faces;
      }
    }
  }

  const std::vector<Solid>& faces_of(std::size_t solid, std::size_t toward) {
    const auto [place, is_new] = faces_of_pair_.try_emplace(solid * solids_.size() + toward);
    if (is_new) place->second = exposed(solids_[solid], solids_[toward]);
    return place->second;
  }

  const ColumnMap& map_;
  MeshBuilder builder_;
  std::vector<std::vector<Solid>> solids_;  // of each profile; the last: beyond the border
  std::map<Level, std::vector<std::uint8_t>> profiles_of_level_;
  std::unordered_map<std::size_t, std::vector<Solid>> faces_of_pair_;
};

}  // namespace

TriangleMesh extrude(const ColumnMap& map) { return Extruder(map).extrude(); }

}  // namespace semview::map
