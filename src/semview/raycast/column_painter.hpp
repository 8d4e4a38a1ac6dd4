// SPDX-License-Identifier: Apache-2.0
/// From the crossings of a ray's line to the runs of its panorama column. Internal to this module.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "semview/map/column_map.hpp"
#include "semview/raycast/column_walk.hpp"
#include "semview/raycast/row_finder.hpp"
#include "semview/view/column_view.hpp"

namespace semview::raycast {

/// The rows of one column, given away from near to far: who comes first has them.
class RowMosaic {
 public:
  void clear(int rows);
  bool full() const;

  /// Gives the rows [begin, end) that are still free to a surface.
  void take(int begin, int end, ClassId label, const RunPlane& plane);

  /// Appends runs from top to bottom, and their planes unless `planes` is null; free rows are
  /// `kNoHit`.
  void append_runs(std::vector<Run>& runs, std::vector<RunPlane>* planes);

 private:
  std::size_t words_ = 0;
  int rows_ = 0;
  std::vector<std::uint64_t> free_;    // a bit a row
  std::vector<std::uint64_t> starts_;  // a bit where a surface begins
  std::vector<ClassId> labels_;        // at each start
  std::vector<RunPlane> planes_;       // the same
};

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

  /// Appends the runs of one column, and their planes if made for ranges.
  void paint(std::span<const Crossing> crossings,
             const RowFinder& finder,
             RowMosaic& mosaic,
             std::vector<Run>& runs,
             std::vector<RunPlane>& planes) const;

 private:
  /// A slab, heights from the eye.
  struct Body {
    float bottom_m;
    float top_m;
    ClassId label;
    RunPlane top;        // as seen from above
    RunPlane underside;  // as seen from below
  };
  /// What stands over a pixel, the slab nearest to the eye's height first.
  struct Stack {
    bool outside;
    ClassId ground;
    std::uint32_t first_body;
    std::uint32_t end_body;
  };
  /// The ground or the ceiling. It has one plane, so a column of pixels over which its label stays
  /// is painted at once, unless it lies between the eye and the slabs.
  struct Sheet {
    float height_m;
    RunPlane plane;
    bool shields;
  };
  struct Canvas;

  void paint_body(const Body& body, float near_per_m, float far_per_m, Canvas& canvas) const;

  bool ranges_;
  std::vector<Body> bodies_;
  std::vector<Stack> stacks_;
  Sheet ground_;
  Sheet ceiling_;
  ClassId ceiling_label_ = kNoHit;
};

}  // namespace semview::raycast
