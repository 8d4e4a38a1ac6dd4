// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/plan_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace semview::picture {
namespace {

constexpr double kMaxHeightPerWidth = 1.15;

/// The longest of 1, 2 or 5 times a power of ten that is not longer than `length`.
double round_length(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= length) return factor * power;
  }
  return power;
}

}  // namespace

Extent Extent::nothing() {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  return {kFar, kFar, -kFar, -kFar};
}

void Extent::include(double x_m, double y_m) {
  x_min_m = std::min(x_min_m, x_m);
  y_min_m = std::min(y_min_m, y_m);
  x_max_m = std::max(x_max_m, x_m);
  y_max_m = std::max(y_max_m, y_m);
}

Extent extent_of(const Plan& plan) {
  Extent extent = Extent::nothing();
  const double width_m = plan.image.columns() * plan.resolution_m;
  const double height_m = plan.image.rows() * plan.resolution_m;
  for (const Pose2& corner : {Pose2{0.0, 0.0, 0.0},
                              Pose2{width_m, 0.0, 0.0},
                              Pose2{0.0, height_m, 0.0},
                              Pose2{width_m, height_m, 0.0}}) {
    const Pose2 placed = plan.origin * corner;
    extent.include(placed.x_m, placed.y_m);
  }
  return extent;
}

PlanFrame::PlanFrame(const Extent& extent, double width_px, double right_px, bool title)
    : extent_(extent), left_(kMargin + 34.0), top_(kMargin + (title ? 30.0 : 0.0)) {
  const double room = std::max(width_px - left_ - kMargin - right_px, 100.0);
  px_per_m_ = std::min(room / (extent_.x_max_m - extent_.x_min_m),
                       kMaxHeightPerWidth * room / (extent_.y_max_m - extent_.y_min_m));
}

void PlanFrame::enter_map(cairo_t* cr) const {
  cairo_translate(cr, x(0.0), y(0.0));
  cairo_scale(cr, px_per_m_, -px_per_m_);
}

void PlanFrame::clip(cairo_t* cr) const {
  cairo_rectangle(cr, left_, top_, width(), height());
  cairo_clip(cr);
}

void PlanFrame::draw_plan(cairo_t* cr, const Plan& plan, double fade) const {
  cairo_save(cr);
  clip(cr);
  cairo_save(cr);
  enter_map(cr);
  cairo_translate(cr, plan.origin.x_m, plan.origin.y_m);
  cairo_rotate(cr, plan.origin.yaw_rad);
  // Pixels count downwards from the upper-left corner.
  cairo_translate(cr, 0.0, plan.image.rows() * plan.resolution_m);
  cairo_scale(cr, plan.resolution_m, -plan.resolution_m);
  paint_image(cr, plan.image);
  cairo_restore(cr);
  if (fade > 0.0) {
    set_colour(cr, {255, 255, 255}, fade);
    fill_rectangle(cr, left_, top_, width(), height());
  }
  cairo_restore(cr);
}

void PlanFrame::draw_edges(cairo_t* cr, const std::string& title) const {
  set_colour(cr, kInk);
  if (!title.empty()) draw_text(cr, left_, kMargin + 14.0, title, kTitleSize, Align::kLeft, true);
  outline_rectangle(cr, left_, top_, width(), height());
  const auto ticks = [](double low, double high, double length) {
    return round_ticks(low, high, std::clamp(static_cast<int>(length / 90.0), 2, 12));
  };
  const std::vector<double> xs = ticks(extent_.x_min_m, extent_.x_max_m, width());
  const double x_step = xs.size() > 1 ? xs[1] - xs[0] : 1.0;
  for (const double tick : xs) {
    set_colour(cr, kInk);
    fill_rectangle(cr, x(tick) - 0.5, bottom(), 1.0, 5.0);
    set_colour(cr, kFaintInk);
    draw_text(
        cr, x(tick), bottom() + 18.0, tick_text(tick, x_step), kSmallTextSize, Align::kCentre);
  }
  const std::vector<double> ys = ticks(extent_.y_min_m, extent_.y_max_m, height());
  const double y_step = ys.size() > 1 ? ys[1] - ys[0] : 1.0;
  for (const double tick : ys) {
    set_colour(cr, kInk);
    fill_rectangle(cr, left_ - 5.0, y(tick) - 0.5, 5.0, 1.0);
    set_colour(cr, kFaintInk);
    draw_text(
        cr, left_ - 8.0, y(tick) + 4.0, tick_text(tick, y_step), kSmallTextSize, Align::kRight);
  }
}

double PlanFrame::draw_scale_bar(cairo_t* cr, double left, double y) const {
  const double length_m = round_length(width() / px_per_m_ / 4.0);
  const double length = length_m * px_per_m_;
  const std::string text = fmt::format("{:g} m", length_m);
  set_colour(cr, kInk);
  fill_rectangle(cr, left, y - 2.0, length, 4.0);
  fill_rectangle(cr, left, y - 6.0, 1.5, 12.0);
  fill_rectangle(cr, left + length - 1.5, y - 6.0, 1.5, 12.0);
  draw_text(cr, left + length + 10.0, y + 5.0, text, kTextSize);
  return length + 10.0 + text_width(text, kTextSize);
}

}  // namespace semview::picture
