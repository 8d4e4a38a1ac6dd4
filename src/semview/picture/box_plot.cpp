// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/box_plot.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "semview/geometry/angle.hpp"
#include "semview/picture/canvas.hpp"

namespace semview::picture {
namespace {

constexpr double kPanelWidth = 400.0, kPanelHeight = 150.0;
constexpr double kLeft = 58.0, kTop = 96.0, kGapX = 58.0, kGapY = 56.0, kBottom = 44.0;

/// Where a panel's numbers are on the paper.
struct Frame {
  double left = 0.0;
  double top = 0.0;
  double high = 1.0;  ///< of the y axis
  std::size_t places = 1;

  double x(double place) const {
    return left + kPanelWidth * (place - 0.5) / static_cast<double>(places);
  }
  double y(double value) const { return top + kPanelHeight * (1.0 - std::min(value, high) / high); }
  double step() const { return kPanelWidth / static_cast<double>(places); }
};

Frame frame_of(const BoxPanel& panel, double left, double top) {
  Frame frame{left, top, 0.0, 0};
  for (const BoxSeries& series : panel.series) {
    frame.places = std::max(frame.places, series.boxes.size());
    for (const PlotBox& box : series.boxes) frame.high = std::max(frame.high, box.high_whisker);
  }
  for (const BoxCurve& curve : panel.curves) {
    frame.places = std::max(frame.places, curve.values.size());
    for (const double value : curve.values) frame.high = std::max(frame.high, value);
  }
  frame.high = frame.high > 0.0 ? 1.05 * frame.high : 1.0;
  frame.places = std::max<std::size_t>(frame.places, 1);
  return frame;
}

/// Where each panel is, in order.
std::vector<Frame> frames_of(const BoxPlot& plot, std::size_t columns) {
  std::vector<Frame> frames;
  double highest = 0.0;
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    const double left = kLeft + static_cast<double>(i % columns) * (kPanelWidth + kGapX);
    const double top = kTop + static_cast<double>(i / columns) * (kPanelHeight + kGapY);
    frames.push_back(frame_of(plot.panels[i], left, top));
    highest = std::max(highest, frames.back().high);
  }
  if (plot.same_scale) {
    for (Frame& frame : frames) frame.high = highest;
  }
  return frames;
}

void draw_axes(cairo_t* cr, const Frame& frame, const BoxPanel& panel, const std::string& y_axis) {
  const std::vector<double> ticks = round_ticks(0.0, frame.high, 4);
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
  for (const double tick : ticks) {
    set_colour(cr, kMissing);
    fill_rectangle(cr, frame.left, frame.y(tick) - 0.5, kPanelWidth, 1.0);
    set_colour(cr, kInk);
    draw_text(cr,
              frame.left - 6.0,
              frame.y(tick) + 4.0,
              tick_text(tick, step),
              kSmallTextSize,
              Align::kRight);
  }
  for (std::size_t place = 1; place <= frame.places; ++place) {
    set_colour(cr, kInk);
    draw_text(cr,
              frame.x(static_cast<double>(place)),
              frame.top + kPanelHeight + 15.0,
              fmt::format("{}", place),
              kSmallTextSize,
              Align::kCentre);
  }
  set_colour(cr, kFaintInk);
  outline_rectangle(cr, frame.left, frame.top, kPanelWidth, kPanelHeight);
  set_colour(cr, kInk);
  draw_text(cr, frame.left, frame.top - 8.0, panel.title, kTextSize, Align::kLeft, true);
  draw_text(cr, frame.left - 6.0, frame.top - 8.0, y_axis, kSmallTextSize, Align::kRight);
}

void draw_box(cairo_t* cr, const Frame& frame, const PlotBox& box, double middle, double width) {
  const double half = width / 2.0;
  const auto level = [&](double value, double reach) {
    fill_rectangle(cr, middle - reach, frame.y(value) - 0.6, 2.0 * reach, 1.2);
  };
  fill_rectangle(cr,
                 middle - 0.6,
                 frame.y(box.high_whisker),
                 1.2,
                 frame.y(box.high_quartile) - frame.y(box.high_whisker));
  fill_rectangle(cr,
                 middle - 0.6,
                 frame.y(box.low_quartile),
                 1.2,
                 frame.y(box.low_whisker) - frame.y(box.low_quartile));
  level(box.high_whisker, half / 2.0);
  level(box.low_whisker, half / 2.0);
  fill_rectangle(cr,
                 middle - half,
                 frame.y(box.high_quartile),
                 width,
                 std::max(1.0, frame.y(box.low_quartile) - frame.y(box.high_quartile)));
  for (const double value : box.outliers) {
    if (value > frame.high) continue;
    cairo_arc(cr, middle, frame.y(value), 1.3, 0.0, kTwoPi);
    cairo_fill(cr);
  }
  set_colour(cr, {255, 255, 255});
  level(box.median, half);
}

void draw_panel(cairo_t* cr, const Frame& frame, const BoxPanel& panel, const std::string& y_axis) {
  draw_axes(cr, frame, panel, y_axis);
  const double share = 0.8 / static_cast<double>(std::max<std::size_t>(panel.series.size(), 1));
  for (std::size_t s = 0; s < panel.series.size(); ++s) {
    const double offset = -0.4 + share * (static_cast<double>(s) + 0.5);
    for (std::size_t i = 0; i < panel.series[s].boxes.size(); ++i) {
      set_colour(cr, panel.series[s].colour);
      draw_box(cr,
               frame,
               panel.series[s].boxes[i],
               frame.x(static_cast<double>(i + 1) + offset),
               0.8 * share * frame.step());
    }
  }
  for (const BoxCurve& curve : panel.curves) {
    set_colour(cr, curve.colour);
    cairo_new_path(cr);
    for (std::size_t i = 0; i < curve.values.size(); ++i) {
      cairo_line_to(cr, frame.x(static_cast<double>(i + 1)), frame.y(curve.values[i]));
    }
    cairo_set_line_width(cr, 1.8);
    cairo_stroke(cr);
  }
}

void draw_legend(cairo_t* cr, const BoxPlot& plot) {
  std::vector<std::string> seen;
  double left = kLeft;
  const auto entry = [&](const std::string& name, const Rgb& colour, double thickness) {
    if (std::ranges::find(seen, name) != seen.end()) return;
    seen.push_back(name);
    set_colour(cr, colour);
    fill_rectangle(cr, left, 52.0 - thickness / 2.0, 22.0, thickness);
    set_colour(cr, kInk);
    draw_text(cr, left + 28.0, 57.0, name, kTextSize);
    left += 28.0 + text_width(name, kTextSize) + 22.0;
  };
  for (const BoxPanel& panel : plot.panels) {
    for (const BoxSeries& series : panel.series) entry(series.name, series.colour, 10.0);
    for (const BoxCurve& curve : panel.curves) entry(curve.name, curve.colour, 3.0);
  }
}

}  // namespace

Status write_box_plot_svg(const std::filesystem::path& path, const BoxPlot& plot) {
  if (plot.panels.empty()) return fail(ErrorCode::kInvalidArgument, "box plot: nothing to draw");
  const auto columns = static_cast<std::size_t>(std::max(plot.panel_columns, 1));
  const std::size_t rows = (plot.panels.size() + columns - 1) / columns;
  const Size size{kLeft + static_cast<double>(columns) * (kPanelWidth + kGapX),
                  kTop + static_cast<double>(rows) * (kPanelHeight + kGapY) + kBottom - kGapY};
  return write_svg(path, size, [&](cairo_t* cr) {
    set_colour(cr, kInk);
    draw_text(cr, kLeft, 30.0, plot.title, kTitleSize, Align::kLeft, true);
    draw_text(
        cr, kLeft + kPanelWidth, size.height - 10.0, plot.x_axis, kSmallTextSize, Align::kRight);
    draw_legend(cr, plot);
    const std::vector<Frame> frames = frames_of(plot, columns);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      draw_panel(cr, frames[i], plot.panels[i], plot.y_axis);
    }
  });
}

}  // namespace semview::picture
