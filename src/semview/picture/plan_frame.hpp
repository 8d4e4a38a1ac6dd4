// SPDX-License-Identifier: Apache-2.0
/// The part of frame `map` that a picture shows, and what every plan picture has: the plan, metres
/// along its edges, a scale bar. Private to this module.
#pragma once

#include <optional>
#include <string>

#include "semview/picture/canvas.hpp"
#include "semview/picture/plan.hpp"

namespace semview::picture {

/// A rectangle of frame `map` in metres.
struct Extent {
  double x_min_m = 0.0;
  double y_min_m = 0.0;
  double x_max_m = 0.0;
  double y_max_m = 0.0;

  void include(double x_m, double y_m);
  bool empty() const { return !(x_max_m > x_min_m && y_max_m > y_min_m); }
  static Extent nothing();
};

Extent extent_of(const Plan& plan);

/// Maps metres to the paper: y of the map goes up.
class PlanFrame {
 public:
  /// `extent` is shown in a box of `width_px` minus margins and `right_px` (for a colour bar); tall
  /// extents are made smaller.
  PlanFrame(const Extent& extent, double width_px, double right_px, bool title);

  double x(double x_m) const { return left_ + (x_m - extent_.x_min_m) * px_per_m_; }
  double y(double y_m) const { return top_ + (extent_.y_max_m - y_m) * px_per_m_; }
  double left() const { return left_; }
  double top() const { return top_; }
  double width() const { return (extent_.x_max_m - extent_.x_min_m) * px_per_m_; }
  double height() const { return (extent_.y_max_m - extent_.y_min_m) * px_per_m_; }
  double bottom() const { return top_ + height(); }
  double below() const { return bottom() + 26.0; }  ///< under the metres along the edge

  /// Makes metres of frame `map` the units of `cr`; between cairo_save and cairo_restore.
  void enter_map(cairo_t* cr) const;
  void clip(cairo_t* cr) const;
  /// `fade` 0 draws the plan as it is, 1 leaves white paper.
  void draw_plan(cairo_t* cr, const Plan& plan, double fade) const;
  /// Outline, metres along the edges, title.
  void draw_edges(cairo_t* cr, const std::string& title) const;
  /// A bar of a round length whose left end is at (left, y); returns its whole width.
  double draw_scale_bar(cairo_t* cr, double left, double y) const;

 private:
  Extent extent_;
  double left_ = 0.0;
  double top_ = 0.0;
  double px_per_m_ = 1.0;
};

}  // namespace semview::picture
