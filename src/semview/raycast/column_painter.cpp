// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/column_painter.hpp"

#include <algorithm>
#include <cmath>

#include "semview/view/view_profile.hpp"

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
    : ranges_(ranges) {
  for (const ColumnProfile& profile : plan.profiles) {
    const auto first = static_cast<std::uint32_t>(bodies_.size());
    const auto add = [&](const Slab& slab) {
      const double bottom_m = slab.z_min_m - eye_z_m;
      const double top_m = slab.z_max_m - eye_z_m;
      bodies_.push_back({static_cast<float>(bottom_m),
                         static_cast<float>(top_m),
                         slab.label,
                         level_plane(top_m),
                         level_plane(bottom_m)});
    };
    const auto above = std::ranges::find_if(
        profile.slabs, [eye_z_m](const Slab& slab) { return slab.z_max_m > eye_z_m; });
    for (auto slab = above; slab != profile.slabs.end(); ++slab) add(*slab);
    for (auto slab = above; slab != profile.slabs.begin();) add(*--slab);
    stacks_.push_back({profile.outside ? kNoHit : profile.ground,
                       profile.outside || !plan.ceiling ? kNoHit : plan.ceiling->label,
                       first,
                       static_cast<std::uint32_t>(bodies_.size())});
  }
  const auto sheet = [eye_z_m](double height_m, bool shields) {
    return Sheet{static_cast<float>(height_m - eye_z_m), level_plane(height_m - eye_z_m), shields};
  };
  ground_ = sheet(plan.ground_height_m, eye_z_m < plan.ground_height_m);
  if (plan.ceiling) {
    ceiling_ = sheet(plan.ceiling->height_m, eye_z_m > plan.ceiling->height_m);
  }
}

/// Paints one column: opens with `begin`, then stretch by stretch, then `end`.
template <typename Mosaic>
class ColumnPainter::Brush {
 public:
  Brush(const ColumnPainter& painter, const RowFinder& finder, Mosaic& mosaic)
      : painter_(painter),
        finder_(finder),
        mosaic_(mosaic),
        ground_{painter.ground_, finder},
        ceiling_{painter.ceiling_, finder} {}

  void begin() {
    mosaic_.clear();
    ground_.begin();
    ceiling_.begin();
  }

  void stretch(const Stack& stack, float near_per_m, float far_per_m) {
    go_on(ground_, stack.ground, near_per_m, far_per_m);
    go_on(ceiling_, stack.ceiling, near_per_m, far_per_m);
    for (std::uint32_t b = stack.first_body; b < stack.end_body; ++b) {
      body(painter_.bodies_[b], near_per_m, far_per_m);
    }
  }

  void end() {
    finish(ground_, ground_.row_at_infinity);
    finish(ceiling_, ceiling_.row_at_infinity);
  }

 private:
  /// A sheet as far as it has one label, which is painted when that ends.
  struct OpenSheet {
    const Sheet& sheet;
    int row_at_eye;  // a sheet's rows lie between that where it begins and that where it ends
    int row_at_infinity;
    ClassId label = kNoHit;
    int since_row = 0;

    OpenSheet(const Sheet& which, const RowFinder& finder)
        : sheet(which),
          row_at_eye(finder.rows_above(which.height_m * kNearest_per_m)),
          row_at_infinity(finder.rows_above(0.0F)) {}
    void begin() {
      label = kNoHit;
      since_row = row_at_eye;
    }
  };

  void go_on(OpenSheet& open, ClassId label, float near_per_m, float far_per_m) {
    if (open.sheet.shields) {
      open.label = label;
      open.since_row = finder_.rows_above(open.sheet.height_m * near_per_m);
      finish(open, finder_.rows_above(open.sheet.height_m * far_per_m));
      open.label = kNoHit;
      return;
    }
    if (label == open.label) return;
    const int row = near_per_m == kNearest_per_m
                        ? open.row_at_eye
                        : finder_.rows_above(open.sheet.height_m * near_per_m);
    finish(open, row);
    open.label = label;
    open.since_row = row;
  }

  void finish(const OpenSheet& open, int row) {
    if (open.label == kNoHit) return;
    mosaic_.take(
        std::min(open.since_row, row), std::max(open.since_row, row), open.label, open.sheet.plane);
  }

  void body(const Body& body, float near_per_m, float far_per_m) {
    const bool from_above = body.top_m < 0.0F;
    const bool from_below = body.bottom_m > 0.0F;
    if (!painter_.ranges_) {
      mosaic_.take(finder_.rows_above(body.top_m * (from_above ? far_per_m : near_per_m)),
                   finder_.rows_above(body.bottom_m * (from_below ? far_per_m : near_per_m)),
                   body.label,
                   {});
      return;
    }
    const int top = finder_.rows_above(body.top_m * near_per_m);
    const int bottom = finder_.rows_above(body.bottom_m * near_per_m);
    mosaic_.take(top, bottom, body.label, {std::min(near_per_m, kSteepest_per_m), 0.0F});
    if (from_above) {
      mosaic_.take(finder_.rows_above(body.top_m * far_per_m), top, body.label, body.top);
    }
    if (from_below) {
      mosaic_.take(
          bottom, finder_.rows_above(body.bottom_m * far_per_m), body.label, body.underside);
    }
  }

  const ColumnPainter& painter_;
  const RowFinder& finder_;
  Mosaic& mosaic_;
  OpenSheet ground_;
  OpenSheet ceiling_;
};

template <typename Mosaic>
void ColumnPainter::paint_columns(const Crossings& crossings,
                                  const RowFinder& finder,
                                  RunCollection& out) const {
  Mosaic mosaic(finder.rows());
  Brush<Mosaic> brush(*this, finder, mosaic);
  for (std::size_t c = 0; c < crossings.begin.size(); ++c) {
    const std::uint32_t end = crossings.end[c];
    brush.begin();
    float near_per_m = kNearest_per_m;
    for (std::uint32_t i = crossings.begin[c]; i < end; ++i) {
      const float far_per_m = i + 1 == end ? 0.0F : per_m(crossings.all[i + 1].distance_m);
      // Pixels that the ray merely touches do not count.
      if (!(far_per_m < near_per_m)) continue;
      brush.stretch(stacks_[crossings.all[i].profile], near_per_m, far_per_m);
      if (mosaic.full()) break;
      near_per_m = far_per_m;
    }
    brush.end();
    mosaic.append_runs(out);
  }
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
  out.first_run.assign(1, 0);
  const auto words = (static_cast<std::size_t>(finder.rows()) + 63) / 64;
  static_assert(kMaxPanoramaRows <= 16 * 64);
  if (words <= 2) {
    paint_rows<2>(crossings, finder, out);
  } else if (words <= 3) {
    paint_rows<3>(crossings, finder, out);
  } else {
    paint_rows<16>(crossings, finder, out);
  }
}

}  // namespace semview::raycast
