// SPDX-License-Identifier: Apache-2.0
#include "semview/map/object_drawing.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "semview/map/map_limits.hpp"
#include "semview/map/polygon_fill.hpp"

namespace semview::map::detail {
namespace {

static_assert(kMaxObjects + kMaxProfiles <= std::numeric_limits<std::uint16_t>::max());

Eigen::AlignedBox2d box_of(const MapObject& object) {
  Eigen::AlignedBox2d box;
  for (const ObjectPolygon& polygon : object.polygons) {
    for (const Ring& ring : polygon.rings) {
      for (const Eigen::Vector2d& point : ring) box.extend(point);
    }
  }
  return box;
}

std::string text_of(const Eigen::AlignedBox2d& box) {
  return fmt::format("x {:.2f} to {:.2f}, y {:.2f} to {:.2f}",
                     box.min().x(),
                     box.max().x(),
                     box.min().y(),
                     box.max().y());
}

class ObjectDrawing {
 public:
  ObjectDrawing(const std::filesystem::path& path, const ObjectPlan& plan, MapReport& report)
      : path_(path),
        plan_(plan),
        report_(report),
        styles_(plan.drawn.size()),
        style_of_(plan.columns.rows(), plan.columns.columns()) {
    for (std::size_t i = 0; i < styles_.size(); ++i) styles_[i].label = plan.drawn[i];
    std::ranges::copy(plan.columns.profile_of_pixel.pixels(), style_of_.pixels().begin());
    const Bounds bounds = plan.columns.bounds();
    bounds_.extend(Eigen::Vector2d(bounds.min_x_m, bounds.min_y_m));
    bounds_.extend(Eigen::Vector2d(bounds.max_x_m, bounds.max_y_m));
  }

  void draw(const ObjectClass& made) {
    const Eigen::AlignedBox2d box = box_of(made.object);
    if (!bounds_.intersects(box)) {
      add(Severity::kError,
          made.object,
          fmt::format("lies outside the drawing: {} m", text_of(box)),
          fmt::format("coordinates are metres in frame map; the drawing covers {} m",
                      text_of(bounds_)));
      return;
    }
    if (!bounds_.contains(box)) {
      add(Severity::kWarning,
          made.object,
          fmt::format("reaches beyond the drawing: {} m", text_of(box)),
          fmt::format("the drawing covers {} m", text_of(bounds_)));
    }
    const std::uint16_t style = style_of(made.own);
    const std::array<bool, 256> over = replaceable(made.object);
    std::size_t inside = 0;
    std::size_t changed = 0;
    for (const ObjectPolygon& polygon : made.object.polygons) {
      for (const PixelRun& run : pixels_inside(polygon, plan_.columns)) {
        inside += static_cast<std::size_t>(run.end - run.begin);
        changed += fill(run, style, over);
      }
    }
    if (changed == 0) say_nothing_changed(made.object, box, inside);
  }

  /// Gives the plan its final profiles.
  std::vector<MapClass> finish() {
    std::vector<int> profile_of_style(styles_.size(), -1);
    for (std::size_t i = 0; i < plan_.drawn.size(); ++i) profile_of_style[i] = static_cast<int>(i);
    std::vector<ColumnProfile>& profiles = plan_.columns.profiles;
    std::vector<MapClass> added;
    const auto styles = style_of_.pixels();
    const auto pixels = plan_.columns.profile_of_pixel.pixels();
    for (std::size_t i = 0; i < styles.size(); ++i) {
      int& profile = profile_of_style[styles[i]];
      if (profile < 0) {
        const Style& style = styles_[styles[i]];
        const auto same = std::ranges::find(profiles, style.profile);
        profile = static_cast<int>(same - profiles.begin());
        if (same == profiles.end()) {
          profiles.push_back(style.profile);
          added.push_back(style.own);
        }
      }
      pixels[i] = static_cast<std::uint8_t>(profile);
    }
    if (profiles.size() > kMaxProfiles) {
      report_.problems.push_back(file_problem(
          Severity::kError,
          path_,
          fmt::format("{} classes and {} different kinds of objects are too many for one plan",
                      plan_.drawn.size() - 1,
                      added.size()),
          fmt::format("together they are at most {}; give objects of one class the same heights",
                      kMaxProfiles - 1)));
    }
    return added;
  }

 private:
  /// What a pixel may look like by now: the classes of the list, then what objects make of them.
  struct Style {
    ClassId label = kNoHit;
    MapClass own;
    ColumnProfile profile;
  };

  std::uint16_t style_of(const MapClass& own) {
    const auto [place, is_new] = known_.try_emplace(
        {own.name, own.min_height_m, own.max_height_m, own.above, own.below}, std::uint16_t{0});
    if (is_new) {
      place->second = static_cast<std::uint16_t>(styles_.size());
      styles_.push_back({plan_.table.id(own.name).value_or(kNoHit),
                         own,
                         column_profile(plan_.classes, plan_.table, own, plan_.storey)});
    }
    return place->second;
  }

  /// The classes of pixels that an object may change.
  std::array<bool, 256> replaceable(const MapObject& object) const {
    std::array<bool, 256> over{};
    over.fill(object.over.empty());
    for (const std::string& name : object.over) over[plan_.table.id(name).value_or(kNoHit)] = true;
    over[kNoHit] = false;
    return over;
  }

  std::size_t fill(const PixelRun& run, std::uint16_t style, const std::array<bool, 256>& over) {
    std::size_t changed = 0;
    for (int column = run.begin; column < run.end; ++column) {
      std::uint16_t& pixel = style_of_.at(run.row, column);
      if (!over[styles_[pixel].label]) continue;
      pixel = style;
      ++changed;
    }
    return changed;
  }

  void say_nothing_changed(const MapObject& object,
                           const Eigen::AlignedBox2d& box,
                           std::size_t inside) {
    if (inside > 0) {
      add(Severity::kWarning,
          object,
          object.over.empty() ? "covers only pixels outside the building"
                              : "covers no pixel of the classes in its property over",
          "it changes nothing");
      return;
    }
    // A house is a ten-thousandth of a degree: what is that small was not drawn in metres.
    const bool degrees = box.sizes().maxCoeff() < 0.1 * plan_.columns.resolution_m;
    add(degrees ? Severity::kError : Severity::kWarning,
        object,
        fmt::format("covers the centre of no pixel: it is {:.3g} m x {:.3g} m",
                    box.sizes().x(),
                    box.sizes().y()),
        degrees ? "coordinates are metres in frame map, not longitude and latitude"
                : fmt::format("a pixel is {} m", plan_.columns.resolution_m));
  }

  void add(Severity severity, const MapObject& object, std::string message, std::string remedy) {
    MapProblem problem = file_problem(severity, path_, std::move(message), std::move(remedy));
    problem.feature = object.feature;
    report_.problems.push_back(std::move(problem));
  }

  const std::filesystem::path& path_;
  const ObjectPlan& plan_;
  MapReport& report_;
  Eigen::AlignedBox2d bounds_;
  std::vector<Style> styles_;
  std::map<std::tuple<std::string, double, double, std::string, std::string>, std::uint16_t> known_;
  Image<std::uint16_t> style_of_;
};

}  // namespace

std::vector<MapClass> draw_objects(std::span<const ObjectClass> objects,
                                   const std::filesystem::path& path,
                                   const ObjectPlan& plan,
                                   MapReport& report) {
  ObjectDrawing drawing(path, plan, report);
  for (const ObjectClass& made : objects) drawing.draw(made);
  return drawing.finish();
}

}  // namespace semview::map::detail
