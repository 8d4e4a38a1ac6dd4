// SPDX-License-Identifier: Apache-2.0
#include "semview/map/extrusion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "semview/map/column_map.hpp"
#include "semview/map/mesh_builder.hpp"

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

/// The profile of what is not part of the building.
constexpr std::uint8_t kOutside = 0;

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

/// Covers the ones of `pending` with rectangles, largest first to the right, then downwards, and
/// clears them.
template <typename Emit>
void cover_with_rectangles(Image<std::uint8_t>& pending, const Emit& emit) {
  for (int top = 0; top < pending.rows(); ++top) {
    const auto row = pending.row(top);
    for (auto one = std::ranges::find(row, 1); one != row.end();
         one = std::find(one, row.end(), 1)) {
      const auto left = static_cast<int>(one - row.begin());
      const auto right = static_cast<int>(std::find(one, row.end(), 0) - row.begin());
      const auto whole_row_pending = [&](int below) {
        const auto part = pending.row(below).subspan(static_cast<std::size_t>(left),
                                                     static_cast<std::size_t>(right - left));
        return std::all_of(part.begin(), part.end(), [](std::uint8_t p) { return p != 0; });
      };
      int bottom = top + 1;
      while (bottom < pending.rows() && whole_row_pending(bottom)) ++bottom;
      for (int covered = top; covered < bottom; ++covered) {
        const auto pixels = pending.row(covered);
        std::fill(pixels.begin() + left, pixels.begin() + right, std::uint8_t{0});
      }
      emit(top, bottom, left, right);
    }
  }
}

Image<std::uint8_t> transposed(const Image<std::uint8_t>& image) {
  Image<std::uint8_t> turned(image.columns(), image.rows());
  for (int row = 0; row < image.rows(); ++row) {
    for (int column = 0; column < image.columns(); ++column) {
      turned.at(column, row) = image.at(row, column);
    }
  }
  return turned;
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
    faces_of_pair_.resize(solids_.size() * solids_.size());
  }

  TriangleMesh extrude() {
    if (map_.profile_of_pixel.empty()) return {};
    for (const auto& [level, has_level] : profiles_of_level_) add_level(level, has_level);
    // Columns as rows of their own: both kinds of lines then read memory in its order.
    const Image<std::uint8_t> turned = transposed(map_.profile_of_pixel);
    for (int i = 0; i <= turned.rows(); ++i) {
      add_line(turned, i, [&](int from, int to, const Solid& face, bool toward_second) {
        builder_.add_quad({Corner{i, to, face.low_m},
                           Corner{i, from, face.low_m},
                           Corner{i, from, face.high_m},
                           Corner{i, to, face.high_m}},
                          !toward_second,
                          face.label);
      });
    }
    for (int j = 0; j <= map_.rows(); ++j) {
      add_line(
          map_.profile_of_pixel, j, [&](int from, int to, const Solid& face, bool toward_second) {
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

  /// The upright faces along the line above row `j`, between the pixels on both sides of it, runs
  /// of equal ones merged. Beyond the image there is nothing.
  template <typename Emit>
  void add_line(const Image<std::uint8_t>& profiles, int j, const Emit& emit) {
    const std::vector<std::uint8_t> beyond(static_cast<std::size_t>(profiles.columns()), kOutside);
    const std::span<const std::uint8_t> first = j > 0 ? profiles.row(j - 1) : beyond;
    const std::span<const std::uint8_t> second = j < profiles.rows() ? profiles.row(j) : beyond;
    if (std::ranges::equal(first, second)) return;
    for (const bool toward_second : {true, false}) {
      add_faces(toward_second ? first : second,
                toward_second ? second : first,
                [&](int from, int to, const Solid& face) { emit(from, to, face, toward_second); });
    }
  }

  /// Those of the solids on one side of a line that are seen from the other.
  template <typename Emit>
  void add_faces(std::span<const std::uint8_t> solid,
                 std::span<const std::uint8_t> toward,
                 const Emit& emit) {
    const std::vector<Solid> none;
    const std::vector<Solid>* current = &none;
    std::vector<std::pair<Solid, int>> open;  // face and where it began
    for (std::size_t k = 0; k <= solid.size(); ++k) {
      const std::vector<Solid>& faces = k < solid.size() ? faces_of(solid[k], toward[k]) : none;
      if (&faces == current) continue;
      const auto at = static_cast<int>(k);
      const auto ends = [&](const std::pair<Solid, int>& run) {
        return std::find(faces.begin(), faces.end(), run.first) == faces.end();
      };
      for (const auto& run : open) {
        if (ends(run)) emit(run.second, at, run.first);
      }
      std::erase_if(open, ends);
      for (const Solid& face : faces) {
        const auto is_open = [&](const auto& run) { return run.first == face; };
        if (std::none_of(open.begin(), open.end(), is_open)) open.emplace_back(face, at);
      }
      current = &faces;
    }
  }

  const std::vector<Solid>& faces_of(std::size_t solid, std::size_t toward) {
    std::optional<std::vector<Solid>>& faces = faces_of_pair_[solid * solids_.size() + toward];
    if (!faces) faces = exposed(solids_[solid], solids_[toward]);
    return *faces;
  }

  const ColumnMap& map_;
  MeshBuilder builder_;
  std::vector<std::vector<Solid>> solids_;  // of each profile
  std::map<Level, std::vector<std::uint8_t>> profiles_of_level_;
  std::vector<std::optional<std::vector<Solid>>> faces_of_pair_;  // a row for each that is solid
};

}  // namespace

TriangleMesh extrude(const ColumnMap& map) { return Extruder(map).extrude(); }

}  // namespace semview::map
