// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/heat_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "semview/picture/canvas.hpp"
#include "semview/picture/colour_map.hpp"
#include "semview/picture/plan_frame.hpp"

namespace semview::picture {
namespace {

struct Limits {
  double low = 0.0;
  double high = 1.0;
};

Limits limits_of(const Image<float>& values) {
  Limits limits{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const float value : values.pixels()) {
    if (!std::isfinite(value)) continue;
    limits.low = std::min(limits.low, static_cast<double>(value));
    limits.high = std::max(limits.high, static_cast<double>(value));
  }
  return limits.low <= limits.high ? limits : Limits{};
}

void draw_cells(cairo_t* cr, const PlanFrame& frame, const HeatPicture& picture, Limits limits) {
  const Image<float>& values = picture.values;
  RgbImage colours(values.rows(), values.columns());
  Image<unsigned char> opacity(values.rows(), values.columns(), 0);
  const double spread = limits.high > limits.low ? limits.high - limits.low : 1.0;
  for (int r = 0; r < values.rows(); ++r) {
    for (int c = 0; c < values.columns(); ++c) {
      if (!std::isfinite(values.at(r, c))) continue;
      colours.at(r, c) = viridis((values.at(r, c) - limits.low) / spread);
      opacity.at(r, c) = 255;
    }
  }
  cairo_save(cr);
  frame.clip(cr);
  frame.enter_map(cr);
  // Row 0 is the lowest already: no turning over.
  cairo_translate(cr, picture.x_min_m, picture.y_min_m);
  cairo_scale(cr, picture.step_m, picture.step_m);
  paint_image(cr, colours, opacity);
  cairo_restore(cr);
}

void draw_truth(cairo_t* cr, const PlanFrame& frame, const Pose2& pose) {
  const double x = frame.x(pose.x_m);
  const double y = frame.y(pose.y_m);
  constexpr double kRadius = 11.0;
  const auto ring = [&] {
    cairo_new_path(cr);
    cairo_arc(cr, x, y, kRadius, 0.0, kTwoPi);
    cairo_new_sub_path(cr);
    const double dx = std::cos(pose.yaw_rad);
    const double dy = -std::sin(pose.yaw_rad);
    cairo_move_to(cr, x + kRadius * dx, y + kRadius * dy);
    cairo_line_to(cr, x + 2.1 * kRadius * dx, y + 2.1 * kRadius * dy);
  };
  ring();
  set_colour(cr, {255, 255, 255});
  cairo_set_line_width(cr, 6.0);
  cairo_stroke(cr);
  ring();
  set_colour(cr, {0, 0, 0});
  cairo_set_line_width(cr, 2.5);
  cairo_stroke(cr);
}

void draw_best(cairo_t* cr, const PlanFrame& frame, const Pose2& pose) {
  const double x = frame.x(pose.x_m);
  const double y = frame.y(pose.y_m);
  for (const bool halo : {true, false}) {
    set_colour(cr, halo ? Rgb{255, 255, 255} : Rgb{213, 0, 50});
    cairo_set_line_width(cr, halo ? 6.5 : 3.0);
    cairo_move_to(cr, x - 8.0, y - 8.0);
    cairo_line_to(cr, x + 8.0, y + 8.0);
    cairo_move_to(cr, x - 8.0, y + 8.0);
    cairo_line_to(cr, x + 8.0, y - 8.0);
    cairo_stroke(cr);
  }
}

/// Scale bar and the meaning of the marks, in one line under the plan.
void draw_key(cairo_t* cr, const PlanFrame& frame, const HeatPicture& picture) {
  const double y = frame.below() + 18.0;
  double x = frame.left() + frame.draw_scale_bar(cr, frame.left(), y) + 36.0;
  cairo_set_line_width(cr, 2.5);
  if (picture.truth) {
    set_colour(cr, {0, 0, 0});
    cairo_arc(cr, x + 8.0, y, 7.0, 0.0, kTwoPi);
    cairo_stroke(cr);
    draw_text(cr, x + 24.0, y + 5.0, "true pose", kTextSize);
    x += 24.0 + text_width("true pose", kTextSize) + 30.0;
  }
  if (picture.best) {
    set_colour(cr, {213, 0, 50});
    cairo_move_to(cr, x, y - 6.0);
    cairo_line_to(cr, x + 12.0, y + 6.0);
    cairo_move_to(cr, x, y + 6.0);
    cairo_line_to(cr, x + 12.0, y - 6.0);
    cairo_stroke(cr);
    set_colour(cr, kInk);
    draw_text(cr, x + 22.0, y + 5.0, "best cell", kTextSize);
  }
}

}  // namespace

RgbImage draw_heat_map(const HeatPicture& picture) {
  Extent extent = picture.plan ? extent_of(*picture.plan) : Extent::nothing();
  extent.include(picture.x_min_m, picture.y_min_m);
  extent.include(picture.x_min_m + picture.values.columns() * picture.step_m,
                 picture.y_min_m + picture.values.rows() * picture.step_m);
  if (extent.empty()) return {};
  const PlanFrame frame(extent, picture.width_px, kColourBarWidth + 18.0, !picture.title.empty());
  const Limits limits = limits_of(picture.values);
  const Size size{frame.left() + frame.width() + 18.0 + kColourBarWidth + kMargin,
                  frame.below() + 34.0 + kMargin};
  return draw_pixels(size, [&](cairo_t* cr) {
    if (picture.plan) frame.draw_plan(cr, *picture.plan, 0.45);
    if (!picture.values.empty()) draw_cells(cr, frame, picture, limits);
    frame.draw_edges(cr, picture.title);
    if (picture.best) draw_best(cr, frame, *picture.best);
    if (picture.truth) draw_truth(cr, frame, *picture.truth);
    draw_colour_bar(cr,
                    frame.left() + frame.width() + 18.0,
                    frame.top(),
                    frame.height(),
                    limits.low,
                    limits.high,
                    picture.quantity,
                    false);
    draw_key(cr, frame, picture);
  });
}

}  // namespace semview::picture
