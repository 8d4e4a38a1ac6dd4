// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/column_painter.hpp"

#include <algorithm>
#include <cmath>

namespace semview::raycast {
namespace {

// Of the eye's own place; times any height it is finite.
constexpr float kNearest_per_m = 1e30F;
constexpr float kSteepest_per_m = 1.0F / kMinPlaneDistance_m;

RunPlane level_plane(double height_m) {
  const double nearest_m = kMinPlaneDistance_m;
  const double distance_m = std::copysign(std::max(std::abs(height_m), nearest_m), height_m);
  return {0.0F, static_cast<float>(1.0 / distance_m)};
}

float per_m(float distance_m) { return 1.0F / std::max(distance_m, 1.0F / kNearest_per_m); }

}  // namespace

ColumnPainter::ColumnPainter(const map::ColumnMap& plan, double eye_z_m, bool ranges)
    : ranges_(ranges), sheets_(1) {
  const auto body = [eye_z_m](const Slab& slab) {
    const double bottom_m = slab.z_min_m - eye_z_m;
    const double top_m = slab.z_max_m - eye_z_m;
    return Body{static_cast<float>(bottom_m),
                static_cast<float>(top_m),
                {slab.label, level_plane(top_m)},
                {slab.label, level_plane(bottom_m)}};
  };
  for (const ColumnProfile& profile : plan.profiles) {
    const auto first = static_cast<std::uint32_t>(bodies_.size());
    const auto above = std::ranges::find_if(
        profile.slabs, [eye_z_m](const Slab& slab) { return slab.z_max_m > eye_z_m; });
    for (auto slab = above; slab != profile.slabs.end(); ++slab) bodies_.push_back(body(*slab));
    for (auto slab = above; slab != profile.slabs.begin();) bodies_.push_back(body(*--slab));
    for (auto slab = profile.slabs.end(); slab != profile.slabs.begin();) {
      bodies_from_top_.push_back(body(*--slab));
    }
    Sheets sheets;
    if (!profile.outside) sheets.ground = profile.ground;
    if (!profile.outside && plan.ceiling) sheets.ceiling = plan.ceiling->label;
    stacks_.push_back({index_of(sheets), first, static_cast<std::uint32_t>(bodies_.size())});
  }
  const auto sheet = [eye_z_m](double height_m, bool shields) {
    return Sheet{static_cast<float>(height_m - eye_z_m), level_plane(height_m - eye_z_m), shields};
  };
  ground_ = sheet(plan.ground_height_m, eye_z_m < plan.ground_height_m);
  if (plan.ceiling) ceiling_ = sheet(plan.ceiling->height_m, eye_z_m > plan.ceiling->height_m);
}

std::uint32_t ColumnPainter::index_of(const Sheets& sheets) {
  const auto known = std::ranges::find(sheets_, sheets);
  const auto index = static_cast<std::uint32_t>(known - sheets_.begin());
  if (known == sheets_.end()) sheets_.push_back(sheets);
  return index;
}

/// Paints one column: `begin`, then stretch by stretch, then `end`.
template <typename Mosaic>
class ColumnPainter::Brush {
 public:
  Brush(const ColumnPainter& painter, const RowTable& table)
      : painter_(painter),
        table_(table),
        mosaic_(table),
        ground_(painter.ground_, table),
        ceiling_(painter.ceiling_, table),
        shielded_(painter.ground_.shields || painter.ceiling_.shields) {}

  void begin() {
    mosaic_.clear();
    sheets_ = 0;
  }

  void stretch(const Stack& stack, float near_per_m, float far_per_m) {
    if (stack.sheets != sheets_) change_sheets(stack.sheets, near_per_m);
    if (shielded_) shield(painter_.sheets_[stack.sheets], near_per_m, far_per_m);
    for (std::uint32_t b = stack.first_body; b < stack.end_body; ++b) {
      body(painter_.bodies_[b], near_per_m, far_per_m);
    }
  }

  /// A whole column of which a closed profile is all that stands in the way: ceiling, faces and
  /// ground follow each other.
  std::uint32_t wall(
      const Stack& before, const Stack& at, float per_m, RunCollection& out, std::uint32_t runs) {
    const Sheets& sheets = painter_.sheets_[before.sheets];
    RunWriter<Mosaic::kHasPlanes> writer(out, runs);
    const Body* bodies = painter_.bodies_from_top_.data();
    const Body* body = bodies + at.first_body;
    writer.add(table_.rows_above(body->top_m * per_m), surface_of(sheets.ceiling, ceiling_.sheet));
    const float near_per_m = std::min(per_m, kSteepest_per_m);
    for (; body != bodies + at.end_body; ++body) {
      writer.add(table_.rows_above(body->bottom_m * per_m),
                 Surface::upright(body->top.label, near_per_m));
    }
    writer.add(table_.rows, surface_of(sheets.ground, ground_.sheet));
    return writer.runs();
  }

  bool full() const { return mosaic_.full(); }

  std::uint32_t end(RunCollection& out, std::uint32_t runs) {
    ground_.close(mosaic_, ground_.row_at_infinity);
    ceiling_.close(mosaic_, ceiling_.row_at_infinity);
    return mosaic_.append_runs(out, runs);
  }

 private:
  /// A sheet as far as it has one label, which is painted when that ends: its rows lie between that
  /// where it begins and that where it ends.
  struct OpenSheet {
    const Sheet& sheet;
    int row_at_eye;
    int row_at_infinity;
    ClassId label = kNoHit;
    int since_row = 0;

    OpenSheet(const Sheet& which, const RowTable& table)
        : sheet(which),
          row_at_eye(table.rows_above(which.height_m * kNearest_per_m)),
          row_at_infinity(table.rows_above(0.0F)) {}

    int row(const RowTable& table, float near_per_m) const {
      return near_per_m == kNearest_per_m ? row_at_eye
                                          : table.rows_above(sheet.height_m * near_per_m);
    }
    void close(Mosaic& mosaic, int until_row) {
      if (label != kNoHit) {
        mosaic.take(
            std::min(since_row, until_row), std::max(since_row, until_row), {label, sheet.plane});
      }
      label = kNoHit;
    }
    void change(Mosaic& mosaic, ClassId to, int at_row) {
      if (to == label) return;
      close(mosaic, at_row);
      label = to;
      since_row = at_row;
    }
  };

  static Surface surface_of(ClassId label, const Sheet& sheet) {
    return label == kNoHit ? Surface() : Surface(label, sheet.plane);
  }

  void change_sheets(std::uint32_t sheets, float near_per_m) {
    sheets_ = sheets;
    const Sheets& now = painter_.sheets_[sheets];
    if (!ground_.sheet.shields) {
      ground_.change(mosaic_, now.ground, ground_.row(table_, near_per_m));
    }
    if (!ceiling_.sheet.shields) {
      ceiling_.change(mosaic_, now.ceiling, ceiling_.row(table_, near_per_m));
    }
  }

  /// Sheets that hide the slabs of their stretch.
  void shield(const Sheets& sheets, float near_per_m, float far_per_m) {
    for (OpenSheet* open : {&ground_, &ceiling_}) {
      if (!open->sheet.shields) continue;
      const ClassId label = open == &ground_ ? sheets.ground : sheets.ceiling;
      open->change(mosaic_, label, open->row(table_, near_per_m));
      open->close(mosaic_, open->row(table_, far_per_m));
    }
  }

  void body(const Body& body, float near_per_m, float far_per_m) {
    const bool from_above = body.top_m < 0.0F;
    const bool from_below = body.bottom_m > 0.0F;
    if constexpr (!Mosaic::kHasPlanes) {
      mosaic_.take(table_.rows_above(body.top_m * (from_above ? far_per_m : near_per_m)),
                   table_.rows_above(body.bottom_m * (from_below ? far_per_m : near_per_m)),
                   body.top);
      return;
    }
    const int top = table_.rows_above(body.top_m * near_per_m);
    const int bottom = table_.rows_above(body.bottom_m * near_per_m);
    mosaic_.take(
        top, bottom, Surface::upright(body.top.label, std::min(near_per_m, kSteepest_per_m)));
    if (from_above) mosaic_.take(table_.rows_above(body.top_m * far_per_m), top, body.top);
    if (from_below) {
      mosaic_.take(bottom, table_.rows_above(body.bottom_m * far_per_m), body.underside);
    }
  }

  const ColumnPainter& painter_;
  RowTable table_;
  Mosaic mosaic_;
  OpenSheet ground_;
  OpenSheet ceiling_;
  bool shielded_;
  std::uint32_t sheets_ = 0;
};

template <typename Mosaic>
void ColumnPainter::paint_columns(const Crossings& crossings,
                                  const RowFinder& finder,
                                  RunCollection& out) const {
  const std::size_t columns = crossings.begin.size();
  const auto rows = static_cast<std::size_t>(finder.table().rows);
  out.first_run.resize(columns + 1);
  Brush<Mosaic> brush(*this, finder.table());
  const Crossing* all = crossings.all.data();
  const Stack* stacks = stacks_.data();
  std::uint32_t runs = 0;
  for (std::size_t c = 0; c < columns; ++c) {
    if (out.runs.size() < runs + rows) out.runs.resize(2 * (runs + rows));
    if (out.planes.size() < out.runs.size()) out.planes.resize(out.runs.size());
    out.first_run[c] = runs;
    const Crossing* begin = all + crossings.begin[c];
    const Crossing* end = all + crossings.end[c];
    if (crossings.ends_closed && end - begin == 2) {
      const Stack& before = stacks[begin->profile];
      const Stack& at = stacks[begin[1].profile];
      if (before.empty() && !at.empty()) {
        runs = brush.wall(before, at, per_m(begin[1].distance_m), out, runs);
        continue;
      }
    }
    brush.begin();
    float near_per_m = kNearest_per_m;
    for (const Crossing* crossing = begin; crossing != end; ++crossing) {
      const float far_per_m = crossing + 1 == end ? 0.0F : per_m(crossing[1].distance_m);
      // Pixels that the ray merely touches do not count.
      if (!(far_per_m < near_per_m)) continue;
      const Stack& stack = stacks[crossing->profile];
      brush.stretch(stack, near_per_m, far_per_m);
      if (!stack.empty() && brush.full()) break;
      near_per_m = far_per_m;
    }
    runs = brush.end(out, runs);
  }
  out.first_run[columns] = runs;
}

template <std::size_t kWords>
void ColumnPainter::paint_rows(const Crossings& crossings,
                               const RowFinder& finder,
                               RunCollection& out) const {
  if (ranges_) {
    paint_columns<RowMosaic<kWords, true>>(crossings, finder, out);
  } else {
    paint_columns<RowMosaic<kWords, false>>(crossings, finder, out);
  }
}

void ColumnPainter::paint(const Crossings& crossings,
                          const RowFinder& finder,
                          RunCollection& out) const {
  if (finder.words() == 2) {
    paint_rows<2>(crossings, finder, out);
  } else if (finder.words() == 3) {
    paint_rows<3>(crossings, finder, out);
  } else {
    paint_rows<16>(crossings, finder, out);
  }
}

}  // namespace semview::raycast
