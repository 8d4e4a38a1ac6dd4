// SPDX-License-Identifier: Apache-2.0
#include "plan_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "semview/core/random.hpp"
#include "semview/geometry/image.hpp"
#include "semview/io/png.hpp"
#include "semview/io/text_file.hpp"

namespace semview::paper2017 {
namespace {

/// What one draws with: a colour and the heights that the whole class has.
struct Pen {
  const char* name;
  Rgb color;
  double min_height_m;
  double max_height_m;
  const char* stacked;  ///< what stacked plans add
};

constexpr Rgb kOutside{0, 0, 0};
constexpr double kMargin_m = 0.5;

constexpr std::array<Pen, 10> kPens = {{
    {"wall", {120, 120, 120}, 0.0, 2.75, ""},
    {"dividing wall", {180, 150, 120}, 0.0, 1.70, ""},
    {"floor", {80, 50, 50}, 0.0, 0.0, ""},
    {"door", {8, 255, 51}, 0.0, 2.05, ", above: wall"},
    {"window", {230, 230, 230}, 0.90, 2.15, ", below: wall, above: wall"},
    {"table", {255, 6, 82}, 0.68, 0.75, ""},
    {"chair", {204, 70, 3}, 0.40, 0.95, ""},
    {"cupboard", {224, 5, 255}, 0.0, 1.90, ""},
    {"sideboard", {6, 51, 255}, 0.0, 0.80, ""},
    {"sink", {0, 163, 255}, 0.65, 0.88, ""},
}};

const Pen& pen(std::string_view name) {
  return *std::ranges::find_if(kPens, [&](const Pen& one) { return name == one.name; });
}

const char* drawn_as(FurnitureKind kind) {
  switch (kind) {
    case FurnitureKind::kDesk:
    case FurnitureKind::kTable:
      return "table";
    case FurnitureKind::kChair:
    case FurnitureKind::kSwivelChair:
      return "chair";
    case FurnitureKind::kCupboard:
      return "cupboard";
    case FurnitureKind::kSideboard:
      return "sideboard";
    case FurnitureKind::kSink:
      return "sink";
    case FurnitureKind::kDividingWall:
      return "dividing wall";
  }
  return "";
}

class Sheet {
 public:
  Sheet(const Layout& layout, const PlanConfig& config, std::uint64_t seed)
      : layout_(layout),
        config_(config),
        rng_(seed, "drawing"),
        image_(pixels(layout.depth_m + 2.0 * kMargin_m),
               pixels(layout.width_m + 2.0 * kMargin_m),
               kOutside) {}

  RgbImage draw() {
    const double outer_m = layout_.walls.front().thickness_m / 2.0;
    fill(layout_.width_m / 2.0,
         layout_.depth_m / 2.0,
         0.0,
         layout_.width_m + 2.0 * outer_m,
         layout_.depth_m + 2.0 * outer_m,
         pen("floor").color);
    for (const Furniture& piece : layout_.furniture) furniture(piece);
    std::vector<double> shifts_m;
    for (const Wall& wall : layout_.walls) {
      shifts_m.push_back(error());
      along(wall, shifts_m.back(), wall.from_m, wall.to_m, wall.thickness_m, "wall");
    }
    for (const Opening& opening : layout_.openings) {
      this->opening(opening, shifts_m[opening.wall]);
    }
    return std::move(image_);
  }

 private:
  int pixels(double length_m) const {
    return static_cast<int>(std::lround(length_m / config_.resolution_m));
  }

  double error() { return rng_.normal(0.0, config_.hand_error_m); }

  /// A turned rectangle: the pixels whose centres it holds.
  void fill(double x_m, double y_m, double yaw_rad, double length_m, double width_m, Rgb color) {
    const double c = std::cos(yaw_rad);
    const double s = std::sin(yaw_rad);
    const double reach_m = std::hypot(length_m, width_m) / 2.0;
    const auto column_at = [&](double at_m) {
      return static_cast<int>(std::floor((at_m + kMargin_m) / config_.resolution_m));
    };
    for (int v = column_at(y_m - reach_m); v <= column_at(y_m + reach_m); ++v) {
      for (int u = column_at(x_m - reach_m); u <= column_at(x_m + reach_m); ++u) {
        if (v < 0 || v >= image_.rows() || u < 0 || u >= image_.columns()) continue;
        const double dx = (u + 0.5) * config_.resolution_m - kMargin_m - x_m;
        const double dy = (v + 0.5) * config_.resolution_m - kMargin_m - y_m;
        if (std::abs(c * dx + s * dy) <= length_m / 2.0 &&
            std::abs(-s * dx + c * dy) <= width_m / 2.0) {
          image_.at(image_.rows() - 1 - v, u) = color;
        }
      }
    }
  }

  void along(const Wall& wall,
             double shift_m,
             double from_m,
             double to_m,
             double thickness_m,
             const char* name) {
    const double middle_m = (from_m + to_m) / 2.0;
    const double at_m = wall.at_m + shift_m;
    fill(wall.along_x ? middle_m : at_m,
         wall.along_x ? at_m : middle_m,
         wall.along_x ? 0.0 : kPi / 2.0,
         to_m - from_m,
         thickness_m,
         color(name));
  }

  /// What is not in the subset is floor.
  Rgb color(const char* name) const {
    return has_class(config_.classes, name) ? pen(name).color : pen("floor").color;
  }

  void furniture(const Furniture& piece) {
    const double x_m = piece.drawn_pose.x_m + error();
    const double y_m = piece.drawn_pose.y_m + error();
    const double length_m = std::max(0.1, piece.length_m + error());
    const double width_m = std::max(0.06, piece.width_m + error());
    const char* name = drawn_as(piece.kind);
    if (!piece.in_map || !has_class(config_.classes, name)) return;
    fill(x_m, y_m, piece.drawn_pose.yaw_rad, length_m, width_m, color(name));
  }

  void opening(const Opening& opening, double shift_m) {
    const Wall& wall = layout_.walls[opening.wall];
    const double from_m = opening.from_m + error();
    const double to_m = std::max(from_m + 0.3, opening.to_m + error());
    if (opening.kind == OpeningKind::kWindow) {
      if (!has_class(config_.classes, "window")) return;
      return along(wall, shift_m, from_m, to_m, wall.thickness_m, "window");
    }
    if (!opening.drawn_open) {
      if (!has_class(config_.classes, "door")) return;
      return along(wall, shift_m, from_m, to_m, wall.thickness_m, "door");
    }
    along(wall, shift_m, from_m, to_m, wall.thickness_m + 0.02, "floor");
    if (!has_class(config_.classes, "door")) return;
    // The leaf as plans have it, at a right angle to the wall.
    const double half_m = (to_m - from_m) / 2.0;
    const double across_m = wall.at_m + shift_m + opening.side * half_m;
    fill(wall.along_x ? from_m + 0.03 : across_m,
         wall.along_x ? across_m : from_m + 0.03,
         wall.along_x ? kPi / 2.0 : 0.0,
         2.0 * half_m,
         0.06,
         color("door"));
  }

  const Layout& layout_;
  const PlanConfig& config_;
  Rng rng_;
  RgbImage image_;
};

std::string yaml_text(const PlanConfig& config) {
  std::string yaml = fmt::format(
      "image: occupancy.png\nresolution: {0:g}\norigin: [{1:g}, {1:g}, 0]\nnegate: 0\n"
      "occupied_thresh: 0.65\nfree_thresh: 0.196\nsemview:\n  format: 1\n  id: lab_floor\n"
      "  labels: labels.png\n  ground: {{class: floor, height: 0}}\n  outside: [0, 0, 0]\n"
      "  classes:\n",
      config.resolution_m,
      -kMargin_m);
  for (const Pen& one : kPens) {
    const bool ground = std::string_view(one.name) == "floor";
    if (!ground && !has_class(config.classes, one.name)) continue;
    yaml += fmt::format(
        "    - {{name: {}, color: [{}, {}, {}], min_height: {:g}, max_height: {:g}{}}}\n",
        one.name,
        one.color.r,
        one.color.g,
        one.color.b,
        one.min_height_m,
        one.max_height_m,
        config.stacked ? one.stacked : "");
  }
  return yaml;
}

}  // namespace

const std::vector<std::string>& map_class_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const Pen& one : kPens) names.emplace_back(one.name);
    return names;
  }();
  return kNames;
}

std::string_view name(ClassSubset classes) {
  switch (classes) {
    case ClassSubset::kAll:
      return "all";
    case ClassSubset::kConstructionExtended:
      return "extended";
    case ClassSubset::kConstructionBasic:
      return "basic";
    case ClassSubset::kFurniture:
      return "furniture";
  }
  return "";
}

bool has_class(ClassSubset subset, const std::string& name) {
  const auto one_of = [&](std::initializer_list<const char*> names) {
    return std::ranges::any_of(names, [&](const char* one) { return name == one; });
  };
  switch (subset) {
    case ClassSubset::kAll:
      return true;
    case ClassSubset::kConstructionExtended:
      return one_of({"wall", "dividing wall", "floor", "door", "window"});
    case ClassSubset::kConstructionBasic:
      return one_of({"wall", "dividing wall", "floor"});
    case ClassSubset::kFurniture:
      return one_of({"table", "chair", "cupboard", "sideboard", "sink"});
  }
  return true;
}

Status draw_plan(const Layout& layout,
                 const PlanConfig& config,
                 std::uint64_t seed,
                 const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  SEMVIEW_TRY_STATUS(io::write_png(directory / "labels.png", Sheet(layout, config, seed).draw()));
  return io::write_text_file(directory / "map.yaml", yaml_text(config));
}

}  // namespace semview::paper2017
