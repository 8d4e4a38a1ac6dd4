// SPDX-License-Identifier: Apache-2.0
#include "semview/map/object_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "semview/map/map_limits.hpp"
#include "semview/map/spelling.hpp"

namespace semview::map::detail {
namespace {

using nlohmann::json;

/// Past any map, and far from where doubles lose micrometres.
constexpr double kMaxCoordinate_m = 2'000'000.0;

/// Without line breaks and the like: a problem is one line.
std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return text;
}

std::string name_of(const json& feature, const json* properties) {
  const json* name = properties == nullptr ? nullptr : member(*properties, "name");
  if (name == nullptr) name = member(feature, "id");
  if (name == nullptr && properties != nullptr) name = member(*properties, "id");
  if (name == nullptr) return {};
  if (name->is_string()) return fmt::format("{:.60}", one_line(name->get<std::string>()));
  return name->is_number() ? name->dump() : std::string();
}

std::string text_of(const Eigen::Vector2d& point) {
  return fmt::format("({:.2f}, {:.2f})", point.x(), point.y());
}

}  // namespace

const json* member(const json& value, const char* key) {
  if (!value.is_object()) return nullptr;
  const auto found = value.find(key);
  return found == value.end() || found->is_null() ? nullptr : &*found;
}

ObjectFields::ObjectFields(const json& feature,
                           int number,
                           std::filesystem::path file,
                           std::size_t points_left,
                           MapReport& report)
    : feature_(feature), file_(std::move(file)), points_left_(points_left), report_(report) {
  object_.feature = {number, name_of(feature, member(feature, "properties"))};
}

std::optional<MapObject> ObjectFields::read() {
  const json* type = member(feature_, "type");
  if (type == nullptr || *type != "Feature") {
    error("is not a Feature", "write {\"type\": \"Feature\", \"properties\": …, \"geometry\": …}");
    return std::nullopt;
  }
  static const json kNone = json::object();
  const json* properties = member(feature_, "properties");
  read_properties(properties == nullptr ? kNone : *properties);
  if (const json* geometry = member(feature_, "geometry")) {
    read_geometry(*geometry);
    if (!refused_ && object_.polygons.empty()) {
      add(Severity::kWarning, "has an empty geometry", "draw its outline, or delete it");
    }
  } else {
    add(Severity::kWarning, "has no geometry", "draw its outline, or delete it");
  }
  if (refused_ || object_.polygons.empty()) return std::nullopt;
  return std::move(object_);
}

void ObjectFields::warn_of_misspelt(const json& properties) {
  constexpr std::array<std::string_view, 6> kKnown{
      "class", "min_height", "max_height", "above", "below", "over"};
  std::vector<std::string_view> absent;
  for (const std::string_view key : kKnown) {
    if (!properties.contains(key)) absent.push_back(key);
  }
  for (const auto& [key, value] : properties.items()) {
    if (std::ranges::find(kKnown, key) != kKnown.end()) continue;
    const auto meant = closest_word(key, absent);
    if (!meant) continue;
    add(Severity::kWarning,
        fmt::format("property {} is not used", key),
        fmt::format("did you mean {}?", *meant));
  }
}

void ObjectFields::read_properties(const json& properties) {
  warn_of_misspelt(properties);
  const json* name = member(properties, "class");
  if (name != nullptr && name->is_string()) {
    object_.class_name = name->get<std::string>();
  } else {
    error(name == nullptr ? "has no property class" : "class is not a text",
          "name a class of the map, as \"class\": \"cabinet\"");
  }
  object_.min_height_m = height(properties, "min_height");
  object_.max_height_m = height(properties, "max_height");
  object_.above = filler(properties, "above");
  object_.below = filler(properties, "below");
  if (const json* over = member(properties, "over")) read_over(*over);
}

std::optional<double> ObjectFields::height(const json& properties, const char* key) {
  const json* value = member(properties, key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_number()) {
    error(fmt::format("{} {} is not a number", key, value->dump()),
          fmt::format("write metres without quotes, as \"{}\": 0.9", key));
    return std::nullopt;
  }
  const double height_m = value->get<double>();
  if (std::abs(height_m) <= kMaxHeight_m) return height_m;
  error(fmt::format("{} {} m is out of limits", key, height_m),
        fmt::format("heights lie within {} m of 0", kMaxHeight_m));
  return std::nullopt;
}

std::optional<std::string> ObjectFields::filler(const json& properties, const char* key) {
  const json* value = member(properties, key);
  if (value == nullptr || *value == "") return std::nullopt;  // QGIS writes either for no value
  if (value->is_string()) return *value == "none" ? "" : value->get<std::string>();
  error(fmt::format("{} {} is not a text", key, value->dump()),
        "name a class of the map, or none for nothing");
  return std::nullopt;
}

void ObjectFields::read_over(const json& value) {
  const json list = value.is_array() ? value : json::array({value});
  for (const json& name : list) {
    if (name == "" && !value.is_array()) return;
    if (!name.is_string()) {
      error(fmt::format("over {} is not a text", name.dump()),
            "name the classes that the object may replace");
      return;
    }
    object_.over.push_back(name.get<std::string>());
  }
}

void ObjectFields::read_geometry(const json& geometry) {
  const json* type = member(geometry, "type");
  const std::string kind =
      type != nullptr && type->is_string() ? type->get<std::string>() : "geometry without a type";
  if (kind != "Polygon" && kind != "MultiPolygon") {
    error(fmt::format("is a {}", kind), "draw polygons: an object has an area");
    return;
  }
  const json* coordinates = member(geometry, "coordinates");
  if (coordinates == nullptr || !coordinates->is_array()) {
    error(fmt::format("{} without coordinates", kind), "write the list of its rings");
    return;
  }
  if (kind == "Polygon") {
    read_polygon(*coordinates);
    return;
  }
  for (const json& rings : *coordinates) {
    if (refused_) return;
    read_polygon(rings);
  }
}

void ObjectFields::read_polygon(const json& rings) {
  if (!rings.is_array()) {
    error("a polygon is not a list of rings", "write [[[x, y], …]]: the outline, then its holes");
    return;
  }
  ObjectPolygon polygon;
  std::size_t points = 0;
  for (const json& positions : rings) {
    const std::optional<Ring> ring = read_ring(positions);
    if (!ring) return;
    points += ring->size();
    if (points > kMaxPolygonPoints) {
      error(fmt::format("a polygon has more than {} points", kMaxPolygonPoints),
            "simplify its outline: a pixel is the smallest that shows");
      return;
    }
    polygon.rings.push_back(*ring);
  }
  if (polygon.rings.empty()) return;  // an empty geometry, as GeoJSON has it
  if (const auto crossing = crossing_in(polygon)) {
    error(fmt::format("its outline crosses itself or a hole at {}", text_of(*crossing)),
          "draw it without crossings, or as several polygons");
    return;
  }
  object_.polygons.push_back(std::move(polygon));
}

std::optional<Ring> ObjectFields::read_ring(const json& positions) {
  if (!positions.is_array()) {
    error("a ring is not a list of points", "write [[x, y], …]");
    return std::nullopt;
  }
  points_ += positions.size();
  if (points_ > points_left_) {
    error(fmt::format("the file has more than {} points by here", kMaxObjectPoints),
          "simplify the outlines");
    return std::nullopt;
  }
  Ring ring;
  for (const json& position : positions) {
    const std::optional<Eigen::Vector2d> point = read_position(position);
    if (!point) return std::nullopt;
    ring.push_back(*point);
  }
  if (ring.size() < 4) {
    error(fmt::format("a ring has {} point{}", ring.size(), ring.size() == 1 ? "" : "s"),
          "a ring has at least 4, the last of them the first again");
    return std::nullopt;
  }
  if (ring.front() != ring.back()) {
    error(fmt::format(
              "a ring begins at {} and ends at {}", text_of(ring.front()), text_of(ring.back())),
          "close it: the last point is the first again");
    return std::nullopt;
  }
  return ring;
}

std::optional<Eigen::Vector2d> ObjectFields::read_position(const json& position) {
  // A third number is a height, which GeoJSON allows and an outline does not need.
  const bool numbers = position.is_array() && position.size() >= 2 && position[0].is_number() &&
                       position[1].is_number();
  if (!numbers) {
    error(fmt::format("a point is not two numbers: {:.40}",
                      position.dump(-1, ' ', true, json::error_handler_t::replace)),
          "write [x, y] in metres of frame map");
    return std::nullopt;
  }
  const Eigen::Vector2d point(position[0].get<double>(), position[1].get<double>());
  if (point.cwiseAbs().maxCoeff() <= kMaxCoordinate_m) return point;
  error(fmt::format("point {} is out of limits", text_of(point)),
        "coordinates are metres in frame map");
  return std::nullopt;
}

void ObjectFields::add(Severity severity, std::string message, std::string remedy) {
  MapProblem problem =
      file_problem(severity, file_, one_line(std::move(message)), std::move(remedy));
  problem.feature = object_.feature;
  report_.problems.push_back(std::move(problem));
}

void ObjectFields::error(std::string message, std::string remedy) {
  refused_ = true;
  add(Severity::kError, std::move(message), std::move(remedy));
}

}  // namespace semview::map::detail
