// SPDX-License-Identifier: Apache-2.0
/// From the crossings of a ray's line to the runs of its panorama column. Internal to this module.
#pragma once

#include <cstdint>
#include <vector>

#include "semview/map/column_map.hpp"
#include "semview/raycast/column_walk.hpp"
#include "semview/raycast/row_finder.hpp"
#include "semview/raycast/row_mosaic.hpp"

namespace semview::raycast {

/// Paints for one eye. With heights counted from the eye, what is at height z and horizontal
/// distance d has the tangent z / d. So over a stretch of one profile from d to e
///
///     a slab's face     is between bottom / d and top / d
///     a top below eyes  between top / d and top / e
///     an underside      between bottom / e and bottom / d
///     ground, ceiling   between height / d and height / e
///
/// and what is nearer hides what is farther; within a stretch the slab nearer to the eye's height
/// hides the others, and all hide the ground and the ceiling. Rows are (low, high]: a ray exactly
/// at an edge sees what is below it.
class ColumnPainter {
 public:
  /// @param plan  must outlive this.
  ColumnPainter(const map::ColumnMap& plan, double eye_z_m, bool ranges);

  /// Paints every column. What `out` held before is lost.
  void paint(const Crossings& crossings, const RowFinder& finder, RunCollection& out) const;

 private:
  /// A slab, heights from the eye.
  struct Body {
    float bottom_m;
    float top_m;
    Surface top;        // as seen from above
    Surface underside;  // as seen from below
  };
  /// What stands over a pixel, the slab nearest to the eye's height first.
  struct Stack {
    std::uint32_t sheets;  // an index
    std::uint32_t first_body;
    std::uint32_t end_body;

    bool empty() const { return first_body == end_body; }
  };
  /// The ground or the ceiling. It has one plane, so a column of pixels over which its label stays
  /// is painted at once, unless it lies between the eye and the slabs.
  struct Sheet {
    float height_m = 0.0F;
    RunPlane plane;
    bool shields = false;
  };
  /// What ground and what ceiling belong to a profile; `kNoHit` for none.
  struct Sheets {
    ClassId ground = kNoHit;
    ClassId ceiling = kNoHit;

    bool operator==(const Sheets&) const = default;
  };
  template <typename Mosaic>
  class Brush;

  std::uint32_t index_of(const Sheets& sheets);
  template <std::size_t kWords>
  void paint_rows(const Crossings& crossings, const RowFinder& finder, RunCollection& out) const;
  template <typename Mosaic>
  void paint_columns(const Crossings& crossings, const RowFinder& finder, RunCollection& out) const;

  bool ranges_;
  std::vector<Body> bodies_;
  std::vector<Body> bodies_from_top_;  // the same, each stack from the highest slab down
  std::vector<Stack> stacks_;
  std::vector<Sheets> sheets_;  // the first is none
  Sheet ground_;
  Sheet ceiling_;
};

}  // namespace semview::raycast
