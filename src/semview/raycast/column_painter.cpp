// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/column_painter.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace semview::raycast {
namespace {

constexpr std::size_t kWord = 64;
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

void RowMosaic::clear(int rows) {
  rows_ = rows;
  words_ = (static_cast<std::size_t>(rows) + kWord - 1) / kWord;
  free_.assign(words_, ~std::uint64_t{0});
  if (rows % kWord != 0) free_.back() = (std::uint64_t{1} << (rows % kWord)) - 1;
  starts_.assign(words_, 0);
  labels_.resize(static_cast<std::size_t>(rows));
  planes_.resize(static_cast<std::size_t>(rows));
}

bool RowMosaic::full() const {
  std::uint64_t any = 0;
  for (const std::uint64_t word : free_) any |= word;
  return any == 0;
}

void RowMosaic::take(int begin, int end, ClassId label, const RunPlane& plane) {
  if (begin >= end) return;
  const auto first = static_cast<std::size_t>(begin) / kWord;
  const auto last = static_cast<std::size_t>(end - 1) / kWord;
  for (std::size_t w = first; w <= last; ++w) {
    std::uint64_t taken = free_[w];
    if (w == first) taken &= ~std::uint64_t{0} << (static_cast<std::size_t>(begin) % kWord);
    if (w == last)
      taken &= ~std::uint64_t{0} >> (kWord - 1 - static_cast<std::size_t>(end - 1) % kWord);
    free_[w] ^= taken;
    // One more start where a surface goes on into the next word: runs are joined in the end.
    const std::uint64_t starts = taken & ~(taken << 1);
    starts_[w] |= starts;
    for (std::uint64_t bits = starts; bits != 0; bits &= bits - 1) {
      const std::size_t row = w * kWord + static_cast<std::size_t>(std::countr_zero(bits));
      labels_[row] = label;
      planes_[row] = plane;
    }
  }
}

void RowMosaic::append_runs(std::vector<Run>& runs, std::vector<RunPlane>* planes) {
  take(0, rows_, kNoHit, {});
  ClassId label = labels_[0];
  RunPlane plane = planes_[0];
  const auto append = [&](std::size_t end) {
    runs.push_back({static_cast<std::uint16_t>(end), label});
    if (planes != nullptr) planes->push_back(plane);
  };
  for (std::size_t w = 0; w < words_; ++w) {
    for (std::uint64_t bits = starts_[w]; bits != 0; bits &= bits - 1) {
      const std::size_t row = w * kWord + static_cast<std::size_t>(std::countr_zero(bits));
      if (labels_[row] == label && (planes == nullptr || planes_[row] == plane)) continue;
      append(row);
      label = labels_[row];
      plane = planes_[row];
    }
  }
  append(static_cast<std::size_t>(rows_));
}

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
    stacks_.push_back(
        {profile.outside, profile.ground, first, static_cast<std::uint32_t>(bodies_.size())});
  }
  const auto sheet = [eye_z_m](double height_m, bool shields) {
    return Sheet{static_cast<float>(height_m - eye_z_m), level_plane(height_m - eye_z_m), shields};
  };
  ground_ = sheet(plan.ground_height_m, eye_z_m < plan.ground_height_m);
  if (plan.ceiling) {
    ceiling_ = sheet(plan.ceiling->height_m, eye_z_m > plan.ceiling->height_m);
    ceiling_label_ = plan.ceiling->label;
  }
}

/// Where one column is painted.
struct ColumnPainter::Canvas {
  const RowFinder& finder;
  RowMosaic& mosaic;

  /// From a height at one distance to a height at another, in any order.
  void paint_level(const Sheet& sheet, ClassId label, float near_per_m, float far_per_m) {
    const int at_near = finder.rows_above(sheet.height_m * near_per_m);
    const int at_far = finder.rows_above(sheet.height_m * far_per_m);
    mosaic.take(std::min(at_near, at_far), std::max(at_near, at_far), label, sheet.plane);
  }
};

void ColumnPainter::paint_body(const Body& body,
                               float near_per_m,
                               float far_per_m,
                               Canvas& canvas) const {
  const RowFinder& finder = canvas.finder;
  const bool from_above = body.top_m < 0.0F;
  const bool from_below = body.bottom_m > 0.0F;
  if (!ranges_) {
    canvas.mosaic.take(finder.rows_above(body.top_m * (from_above ? far_per_m : near_per_m)),
                       finder.rows_above(body.bottom_m * (from_below ? far_per_m : near_per_m)),
                       body.label,
                       {});
    return;
  }
  const int top = finder.rows_above(body.top_m * near_per_m);
  const int bottom = finder.rows_above(body.bottom_m * near_per_m);
  canvas.mosaic.take(top, bottom, body.label, {std::min(near_per_m, kSteepest_per_m), 0.0F});
  if (from_above) {
    canvas.mosaic.take(finder.rows_above(body.top_m * far_per_m), top, body.label, body.top);
  }
  if (from_below) {
    canvas.mosaic.take(
        bottom, finder.rows_above(body.bottom_m * far_per_m), body.label, body.underside);
  }
}

void ColumnPainter::paint(std::span<const Crossing> crossings,
                          const RowFinder& finder,
                          RowMosaic& mosaic,
                          std::vector<Run>& runs,
                          std::vector<RunPlane>& planes) const {
  /// A sheet as far as it has one label, which is painted when that ends.
  struct Open {
    const Sheet& sheet;
    ClassId label = kNoHit;
    float since_per_m = 0.0F;
  };
  mosaic.clear(finder.rows());
  Canvas canvas{finder, mosaic};
  Open ground{ground_};
  Open ceiling{ceiling_};
  const auto go_on = [&canvas](Open& open, ClassId label, float near_per_m, float far_per_m) {
    if (open.sheet.shields) {
      if (label != kNoHit) canvas.paint_level(open.sheet, label, near_per_m, far_per_m);
      return;
    }
    if (label == open.label) return;
    if (open.label != kNoHit) {
      canvas.paint_level(open.sheet, open.label, open.since_per_m, near_per_m);
    }
    open.label = label;
    open.since_per_m = near_per_m;
  };
  float near_per_m = per_m(crossings.front().distance_m);
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    const bool last = i + 1 == crossings.size();
    const float far_per_m = last ? 0.0F : per_m(crossings[i + 1].distance_m);
    // Pixels that the ray merely touches do not count.
    if (!(far_per_m < near_per_m)) continue;
    const Stack& stack = stacks_[crossings[i].profile];
    go_on(ground, stack.outside ? kNoHit : stack.ground, near_per_m, far_per_m);
    go_on(ceiling, stack.outside ? kNoHit : ceiling_label_, near_per_m, far_per_m);
    for (std::uint32_t b = stack.first_body; b < stack.end_body; ++b) {
      paint_body(bodies_[b], near_per_m, far_per_m, canvas);
    }
    if (mosaic.full()) break;
    near_per_m = far_per_m;
  }
  for (Open* open : {&ground, &ceiling}) go_on(*open, kNoHit, 0.0F, 0.0F);
  mosaic.append_runs(runs, ranges_ ? &planes : nullptr);
}

}  // namespace semview::raycast
