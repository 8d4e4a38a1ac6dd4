// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/line_plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <fmt/format.h>

#include "semview/picture/canvas.hpp"

namespace semview::picture {
namespace {

constexpr double kPanelWidth = 250.0, kPanelHeight = 240.0, kGap = 34.0;
constexpr double kLeft = 70.0, kTop = 84.0, kBottom = 62.0;

/// The logarithm of an axis, a little wider than what lies on it.
struct Scale {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double value) {
    low = std::min(low, std::log10(value));
    high = std::max(high, std::log10(value));
  }
  void widen() {
    const double margin = std::max(0.06 * (high - low), 0.02);
    low -= margin;
    high += margin;
  }
  /// 0 at the low end, 1 at the high one.
  double place(double value) const { return (std::log10(value) - low) / (high - low); }
  /// 1, 2 and 5 times powers of ten, or the powers alone where those are many.
  std::vector<double> ticks() const {
    std::vector<double> ticks;
    for (int power = static_cast<int>(std::floor(low)); power <= static_cast<int>(high); ++power) {
      for (const double digit : {1.0, 2.0, 5.0}) {
        if (digit > 1.0 && high - low > 2.0) continue;
        const double value = digit * std::pow(10.0, power);
        if (place(value) >= 0.0 && place(value) <= 1.0) ticks.push_back(value);
      }
    }
    return ticks;
  }
};

void draw_panel(cairo_t* cr, double left, const PlotPanel& panel, const Scale& y, bool numbers) {
  Scale x;
  for (const PlotLine& line : panel.lines) {
    for (const auto& point : line.points) x.include(point[0]);
  }
  x.widen();
  const auto at_x = [&](double value) { return left + kPanelWidth * x.place(value); };
  const auto at_y = [&](double value) { return kTop + kPanelHeight * (1.0 - y.place(value)); };
  cairo_set_line_width(cr, 1.0);
  for (const double tick : y.ticks()) {
    set_colour(cr, kMissing);
    fill_rectangle(cr, left, at_y(tick), kPanelWidth, 1.0);
    set_colour(cr, kInk);
    if (numbers) {
      draw_text(cr,
                left - 6.0,
                at_y(tick) + 4.0,
                fmt::format("{:g}", tick),
                kSmallTextSize,
                Align::kRight);
    }
  }
  for (const double tick : x.ticks()) {
    set_colour(cr, kMissing);
    fill_rectangle(cr, at_x(tick), kTop, 1.0, kPanelHeight);
    set_colour(cr, kInk);
    draw_text(cr,
              at_x(tick),
              kTop + kPanelHeight + 16.0,
              fmt::format("{:g}", tick),
              kSmallTextSize,
              Align::kCentre);
  }
  set_colour(cr, kFaintInk);
  outline_rectangle(cr, left, kTop, kPanelWidth, kPanelHeight);
  set_colour(cr, kInk);
  draw_text(cr,
            left + kPanelWidth / 2.0,
            kTop + kPanelHeight + 38.0,
            panel.x_axis,
            kTextSize,
            Align::kCentre);
  for (const PlotLine& line : panel.lines) {
    set_colour(cr, line.colour);
    cairo_new_path(cr);
    for (const auto& [px, py] : line.points) cairo_line_to(cr, at_x(px), at_y(py));
    cairo_set_line_width(cr, 2.2);
    cairo_stroke(cr);
    for (const auto& [px, py] : line.points) {
      fill_rectangle(cr, at_x(px) - 2.5, at_y(py) - 2.5, 5.0, 5.0);
    }
  }
}

void draw_legend(cairo_t* cr, const LinePlot& plot) {
  std::vector<std::string> seen;
  double left = kLeft;
  for (const PlotPanel& panel : plot.panels) {
    for (const PlotLine& line : panel.lines) {
      if (std::ranges::find(seen, line.name) != seen.end()) continue;
      seen.push_back(line.name);
      set_colour(cr, line.colour);
      fill_rectangle(cr, left, kTop - 29.0, 22.0, 3.0);
      set_colour(cr, kInk);
      draw_text(cr, left + 28.0, kTop - 23.0, line.name, kTextSize);
      left += 28.0 + text_width(line.name, kTextSize) + 22.0;
    }
  }
}

}  // namespace

Status write_line_plot_svg(const std::filesystem::path& path, const LinePlot& plot) {
  Scale y;
  for (const PlotPanel& panel : plot.panels) {
    for (const PlotLine& line : panel.lines) {
      for (const auto& point : line.points) y.include(point[1]);
    }
  }
  if (y.low > y.high) return fail(ErrorCode::kInvalidArgument, "plot: nothing to draw");
  y.widen();
  const auto panels = static_cast<double>(plot.panels.size());
  const Size size{kLeft + panels * (kPanelWidth + kGap), kTop + kPanelHeight + kBottom};
  return write_svg(path, size, [&](cairo_t* cr) {
    set_colour(cr, kInk);
    draw_text(cr, kLeft, 30.0, plot.title, kTitleSize, Align::kLeft, true);
    draw_text(cr, 10.0, kTop - 8.0, plot.y_axis, kSmallTextSize);
    draw_legend(cr, plot);
    for (std::size_t i = 0; i < plot.panels.size(); ++i) {
      draw_panel(
          cr, kLeft + static_cast<double>(i) * (kPanelWidth + kGap), plot.panels[i], y, i == 0);
    }
  });
}

}  // namespace semview::picture
