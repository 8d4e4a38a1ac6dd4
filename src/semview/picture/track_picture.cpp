// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/track_picture.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "semview/picture/canvas.hpp"
#include "semview/picture/plan_frame.hpp"

namespace semview::picture {
namespace {

Extent extent_of_picture(const TrackPicture& picture) {
  if (picture.plan) return extent_of(*picture.plan);
  Extent extent = Extent::nothing();
  const auto include = [&extent](const std::vector<Pose2>& poses) {
    for (const Pose2& pose : poses) {
      extent.include(pose.x_m - 0.5, pose.y_m - 0.5);
      extent.include(pose.x_m + 0.5, pose.y_m + 0.5);
    }
  };
  for (const Track& track : picture.tracks) include(track.poses);
  include(picture.particles);
  if (extent.empty()) extent = {0.0, 0.0, 1.0, 1.0};
  return extent;
}

void stroke_path(cairo_t* cr, const PlanFrame& frame, const Track& track, bool halo) {
  cairo_new_path(cr);
  for (const Pose2& pose : track.poses) cairo_line_to(cr, frame.x(pose.x_m), frame.y(pose.y_m));
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(cr, halo ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
  constexpr double kDashes[] = {9.0, 5.0};
  cairo_set_dash(cr, kDashes, track.dashed && !halo ? 2 : 0, 0.0);
  set_colour(cr, halo ? Rgb{255, 255, 255} : track.colour, halo ? 0.75 : 1.0);
  cairo_set_line_width(cr, halo ? 6.0 : 2.6);
  cairo_stroke(cr);
  cairo_set_dash(cr, nullptr, 0, 0.0);
}

/// A ring where the track begins, an arrowhead along the heading where it ends.
void mark_ends(cairo_t* cr, const PlanFrame& frame, const Track& track) {
  const Pose2& first = track.poses.front();
  cairo_new_path(cr);
  cairo_arc(cr, frame.x(first.x_m), frame.y(first.y_m), 6.0, 0.0, kTwoPi);
  set_colour(cr, {255, 255, 255});
  cairo_fill_preserve(cr);
  set_colour(cr, track.colour);
  cairo_set_line_width(cr, 2.4);
  cairo_stroke(cr);
  const Pose2& last = track.poses.back();
  cairo_save(cr);
  cairo_translate(cr, frame.x(last.x_m), frame.y(last.y_m));
  cairo_rotate(cr, -last.yaw_rad);
  cairo_move_to(cr, 12.0, 0.0);
  cairo_line_to(cr, -8.0, 7.5);
  cairo_line_to(cr, -4.0, 0.0);
  cairo_line_to(cr, -8.0, -7.5);
  cairo_close_path(cr);
  set_colour(cr, track.colour);
  cairo_fill_preserve(cr);
  set_colour(cr, {255, 255, 255});
  cairo_set_line_width(cr, 1.4);
  cairo_stroke(cr);
  cairo_restore(cr);
}

void draw_particle(cairo_t* cr, double x, double y, double yaw_rad) {
  constexpr double kTick = 7.0;
  cairo_arc(cr, x, y, 2.2, 0.0, kTwoPi);
  cairo_fill(cr);
  cairo_move_to(cr, x, y);
  cairo_line_to(cr, x + kTick * std::cos(yaw_rad), y - kTick * std::sin(yaw_rad));
  cairo_stroke(cr);
}

void draw_particles(cairo_t* cr, const PlanFrame& frame, const std::vector<Pose2>& particles) {
  set_colour(cr, kParticleColour, particles.size() > 500 ? 0.35 : 0.6);
  cairo_set_line_width(cr, 1.0);
  for (const Pose2& pose : particles) {
    draw_particle(cr, frame.x(pose.x_m), frame.y(pose.y_m), pose.yaw_rad);
  }
}

struct LegendItem {
  const Track* track = nullptr;  ///< null: the particles
  std::string text;
  double x = 0.0;
  double y = 0.0;
};

struct Legend {
  std::vector<LegendItem> items;
  double height = 0.0;
};

Legend arrange_legend(const TrackPicture& picture, double width) {
  Legend legend;
  for (const Track& track : picture.tracks) {
    if (!track.poses.empty()) legend.items.push_back({&track, track.name});
  }
  if (!picture.particles.empty()) {
    legend.items.push_back({nullptr, fmt::format("{} particles", picture.particles.size())});
  }
  double x = 0.0;
  double y = 0.0;
  for (LegendItem& item : legend.items) {
    const double item_width = 44.0 + text_width(item.text, kTextSize);
    if (x > 0.0 && x + item_width > width) {
      x = 0.0;
      y += 24.0;
    }
    item.x = x;
    item.y = y;
    x += item_width + 28.0;
  }
  legend.height = legend.items.empty() ? 0.0 : y + 24.0;
  return legend;
}

void draw_legend(cairo_t* cr, const Legend& legend, double left, double top) {
  for (const LegendItem& item : legend.items) {
    const double x = left + item.x;
    const double y = top + item.y + 10.0;
    if (item.track != nullptr) {
      constexpr double kDashes[] = {9.0, 5.0};
      cairo_set_dash(cr, kDashes, item.track->dashed ? 2 : 0, 0.0);
      cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
      cairo_set_line_width(cr, 3.0);
      set_colour(cr, item.track->colour);
      cairo_move_to(cr, x, y);
      cairo_line_to(cr, x + 34.0, y);
      cairo_stroke(cr);
      cairo_set_dash(cr, nullptr, 0, 0.0);
    } else {
      set_colour(cr, kParticleColour);
      cairo_set_line_width(cr, 1.0);
      for (const double offset : {6.0, 17.0, 28.0}) draw_particle(cr, x + offset, y, 0.6);
    }
    set_colour(cr, kInk);
    draw_text(cr, x + 44.0, y + 5.0, item.text, kTextSize);
  }
}

/// The drawing and the paper it needs.
struct Sheet {
  PlanFrame frame;
  Legend legend;
  Size size;
};

Sheet lay_out(const TrackPicture& picture) {
  const PlanFrame frame(extent_of_picture(picture), picture.width_px, 0.0, !picture.title.empty());
  // A tall plan is narrow: the legend may use the paper's whole width.
  const double width = std::max(frame.width(), 420.0);
  const Legend legend = arrange_legend(picture, width);
  return {frame,
          legend,
          {frame.left() + width + kMargin, frame.below() + 40.0 + legend.height + kMargin}};
}

void draw(cairo_t* cr, const Sheet& sheet, const TrackPicture& picture) {
  const PlanFrame& frame = sheet.frame;
  const bool plain = picture.tracks.empty() && picture.particles.empty();
  if (picture.plan) frame.draw_plan(cr, *picture.plan, plain ? 0.0 : 0.45);
  cairo_save(cr);
  frame.clip(cr);
  draw_particles(cr, frame, picture.particles);
  for (const bool halo : {true, false}) {
    for (const Track& track : picture.tracks) stroke_path(cr, frame, track, halo);
  }
  for (const Track& track : picture.tracks) {
    if (!track.poses.empty()) mark_ends(cr, frame, track);
  }
  cairo_restore(cr);
  frame.draw_edges(cr, picture.title);
  frame.draw_scale_bar(cr, frame.left(), frame.below() + 18.0);
  draw_legend(cr, sheet.legend, frame.left(), frame.below() + 40.0);
}

}  // namespace

RgbImage draw_tracks(const TrackPicture& picture) {
  const Sheet sheet = lay_out(picture);
  return draw_pixels(sheet.size, [&](cairo_t* cr) { draw(cr, sheet, picture); });
}

Status write_tracks_svg(const std::filesystem::path& path, const TrackPicture& picture) {
  const Sheet sheet = lay_out(picture);
  return write_svg(path, sheet.size, [&](cairo_t* cr) { draw(cr, sheet, picture); });
}

}  // namespace semview::picture
