// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "semview/io/text_file.hpp"
#include "semview/map/map_limits.hpp"
#include "semview/map/map_object.hpp"
#include "semview/map/object_fields.hpp"

namespace semview::map::detail {
namespace {

using Path = std::filesystem::path;
using nlohmann::json;

constexpr int kMaxDepth = 64;  // GeoJSON itself needs nine
constexpr const char* kRemedy =
    "write a GeoJSON FeatureCollection of Polygon and MultiPolygon features";

/// The file as JSON; none and the reason in the report if it is not.
std::optional<json> parse(const Path& path, MapReport& report) {
  const Result<std::string> text = io::read_text_file(path, kMaxObjectBytes);
  if (!text) {
    MapProblem problem = problem_of(path, text.error());
    const bool large = problem.code == ErrorCode::kOutOfRange;
    if (large) problem.code = ErrorCode::kResourceExhausted;
    problem.remedy = large ? "simplify its outlines: a pixel is the smallest that shows"
                           : "put the file beside map.yaml, or leave out `objects:`";
    report.problems.push_back(std::move(problem));
    return std::nullopt;
  }
  struct TooDeep {};
  try {
    return json::parse(*text, [](int depth, json::parse_event_t, const json&) {
      if (depth > kMaxDepth) throw TooDeep{};
      return true;
    });
  } catch (const json::parse_error& error) {
    const std::size_t end = std::min(error.byte, text->size());
    const auto line = std::count(text->begin(), text->begin() + static_cast<long>(end), '\n') + 1;
    report.problems.push_back(line_problem(
        Severity::kError, path, static_cast<int>(line), "is not JSON from here on", kRemedy));
  } catch (const json::exception& error) {
    report.problems.push_back(file_problem(
        Severity::kError, path, fmt::format("cannot be read: {}", error.what()), kRemedy));
  } catch (const TooDeep&) {
    report.problems.push_back(file_problem(
        Severity::kError, path, fmt::format("is nested deeper than {}", kMaxDepth), kRemedy));
  }
  return std::nullopt;
}

/// The name of a coordinate reference system in degrees, if the old member `crs` names one.
std::optional<std::string> degrees_of(const json& root) {
  const json* crs = member(root, "crs");
  const json* properties = crs == nullptr ? nullptr : member(*crs, "properties");
  if (properties == nullptr) return std::nullopt;
  std::string name;
  if (const json* text = member(*properties, "name"); text != nullptr && text->is_string()) {
    name = text->get<std::string>();
  } else if (const json* code = member(*properties, "code"); code != nullptr) {
    name = "EPSG:" + code->dump();
  }
  constexpr std::array<std::string_view, 4> kEpsg{"4326", "4258", "4269", "4979"};
  const bool degrees =
      name.find("CRS84") != std::string::npos ||
      (name.find("EPSG") != std::string::npos &&
       std::ranges::any_of(kEpsg, [&](std::string_view code) { return name.ends_with(code); }));
  return degrees ? std::optional(name) : std::nullopt;
}

/// The members of the root; null and the reason in the report if it is no collection.
const json* features_of(const json& root, const Path& path, MapReport& report) {
  const auto error = [&](std::string message, std::string remedy) {
    report.problems.push_back(
        file_problem(Severity::kError, path, std::move(message), std::move(remedy)));
    return nullptr;
  };
  const json* type = member(root, "type");
  if (type == nullptr || *type != "FeatureCollection") {
    return error("is not a FeatureCollection", kRemedy);
  }
  const json* features = member(root, "features");
  if (features == nullptr || !features->is_array()) {
    return error("has no list `features`", kRemedy);
  }
  if (features->size() > kMaxObjects) {
    return error(fmt::format("{} features are too many", features->size()),
                 fmt::format("a map has at most {}", kMaxObjects));
  }
  if (const auto name = degrees_of(root)) {
    return error(fmt::format("crs {} counts in degrees", *name),
                 "coordinates are metres in frame map; draw without a coordinate reference system");
  }
  return features;
}

}  // namespace

std::vector<MapObject> read_objects(const Path& path, MapReport& report) {
  const std::optional<json> root = parse(path, report);
  const json* features = root ? features_of(*root, path, report) : nullptr;
  std::vector<MapObject> objects;
  if (features == nullptr) return objects;
  std::size_t points = 0;
  for (std::size_t i = 0; i < features->size(); ++i) {
    ObjectFields fields(
        (*features)[i], static_cast<int>(i) + 1, path, kMaxObjectPoints - points, report);
    std::optional<MapObject> object = fields.read();
    points += fields.points();
    if (points > kMaxObjectPoints) break;
    if (object) objects.push_back(*std::move(object));
  }
  return objects;
}

}  // namespace semview::map::detail
