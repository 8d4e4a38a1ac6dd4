// SPDX-License-Identifier: Apache-2.0
#include "semview/map/plan_import.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "semview/io/png.hpp"
#include "semview/io/yaml_document.hpp"
#include "semview/map/bundle_writer.hpp"

namespace semview::map {
namespace {

/// What people move about; a plan does not say it.
constexpr std::array<std::string_view, 9> kFurniture = {
    "armchair", "bed", "chair", "coffee table", "desk", "lamp", "sofa", "swivel chair", "table"};
constexpr double kFurnitureMovable = 0.5;

struct PlanClass {
  std::string name;
  Rgb color;
  double z_min_m = 0.0;
  double z_max_m = 0.0;
};

Result<Rgb> read_color(const io::YamlNode& node) {
  SEMVIEW_TRY(const std::vector<double> numbers, node.numbers(3));
  Rgb color;
  const std::array<unsigned char*, 3> channels{&color.r, &color.g, &color.b};
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (!(numbers[i] >= 0.0 && numbers[i] <= 255.0)) {
      return node.error(fmt::format("colour value {} is not in 0..255", numbers[i]));
    }
    *channels[i] = static_cast<unsigned char>(numbers[i]);
  }
  return color;
}

Result<std::vector<PlanClass>> read_plan_classes(const io::YamlNode& plan) {
  SEMVIEW_TRY(const io::YamlNode list, plan.at("classes"));
  if (list.items().empty()) return list.error("expected a list of classes");
  std::vector<PlanClass> classes;
  for (const io::YamlNode& item : list.items()) {
    PlanClass entry;
    SEMVIEW_TRY(const io::YamlNode name, item.at("name"));
    SEMVIEW_TRY(entry.name, name.text());
    SEMVIEW_TRY(const io::YamlNode rgb, item.at("rgb"));
    SEMVIEW_TRY(entry.color, read_color(rgb));
    SEMVIEW_TRY(entry.z_min_m, item.number_or("z_min", 0.0));
    SEMVIEW_TRY(entry.z_max_m, item.number_or("z_max", 0.0));
    classes.push_back(std::move(entry));
  }
  return classes;
}

bool has_class(const std::vector<PlanClass>& classes, std::string_view name) {
  return std::any_of(
      classes.begin(), classes.end(), [&](const PlanClass& c) { return c.name == name; });
}

/// Keys `above_door`, `below_window`… and the cabinet that a worktop stands on.
Status stack(MapClass& value, const io::YamlNode& plan, const std::vector<PlanClass>& classes) {
  if (value.name == "door") {
    SEMVIEW_TRY(value.above, plan.text_or("above_door", ""));
  }
  if (value.name == "window" || value.name == "windowpane") {
    SEMVIEW_TRY(value.above, plan.text_or("above_window", ""));
    SEMVIEW_TRY(value.below, plan.text_or("below_window", ""));
  }
  if (value.name == "countertop" && has_class(classes, "cabinet")) value.below = "cabinet";
  return {};
}

Status add_classes(detail::BundleText& text,
                   const io::YamlNode& plan,
                   const std::vector<PlanClass>& classes) {
  text.outside = Rgb{0, 0, 0};
  for (const PlanClass& entry : classes) {
    if (entry.name == "unknown") {
      text.outside = entry.color;
      continue;
    }
    MapClass value;
    value.name = entry.name;
    value.color = entry.color;
    value.min_height_m = entry.z_min_m;
    value.max_height_m = entry.z_max_m;
    value.passable = entry.name == "door";
    const bool furniture =
        std::find(kFurniture.begin(), kFurniture.end(), entry.name) != kFurniture.end();
    value.movable = furniture ? kFurnitureMovable : 0.0;
    SEMVIEW_TRY_STATUS(stack(value, plan, classes));
    text.classes.push_back(std::move(value));
  }
  if (!has_class(classes, "floor")) {
    MapClass floor;
    floor.name = "floor";
    text.classes.push_back(std::move(floor));
  }
  if (!text.ceiling_class.empty() && !has_class(classes, text.ceiling_class)) {
    MapClass ceiling;
    ceiling.name = text.ceiling_class;
    text.classes.push_back(std::move(ceiling));
  }
  return {};
}

}  // namespace

Status import_plan(const std::filesystem::path& plan_yaml, const std::filesystem::path& directory) {
  SEMVIEW_TRY(const io::YamlNode plan, io::read_yaml(plan_yaml));
  SEMVIEW_TRY(const std::vector<PlanClass> classes, read_plan_classes(plan));
  SEMVIEW_TRY(const io::YamlNode image, plan.at("image"));
  SEMVIEW_TRY(const std::string image_name, image.text());
  SEMVIEW_TRY(const RgbImage labels, io::read_png_rgb(plan_yaml.parent_path() / image_name));

  detail::BundleText text;
  text.comment =
      fmt::format("Made by `semview map import plan` from {}.", plan_yaml.filename().string());
  SEMVIEW_TRY(text.name, plan.text_or("name", plan_yaml.stem().string()));
  SEMVIEW_TRY(const io::YamlNode resolution, plan.at("resolution"));
  SEMVIEW_TRY(text.resolution_m, resolution.number());
  SEMVIEW_TRY(const io::YamlNode origin, plan.at("origin"));
  SEMVIEW_TRY(const std::vector<double> numbers, origin.numbers(3));
  text.origin = {numbers[0], numbers[1], numbers[2]};
  text.ground_class = "floor";
  if (const std::optional<io::YamlNode> ceiling = plan.find("ceiling_z")) {
    SEMVIEW_TRY(text.ceiling_height_m, ceiling->number());
    text.ceiling_class = "ceiling";
  }
  SEMVIEW_TRY_STATUS(add_classes(text, plan, classes));
  return detail::write_bundle(text, labels, directory);
}

}  // namespace semview::map
