// SPDX-License-Identifier: Apache-2.0
#include "semview/map/object_writer.hpp"

#include <array>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace semview::map::detail {
namespace {

/// Pixels of rows top <= row < bottom and columns left <= column < right.
struct Rectangle {
  int top = 0;
  int bottom = 0;
  int left = 0;
  int right = 0;
};

/// The pixels of one profile: runs of a row, those below each other with equal ends as one.
std::vector<Rectangle> rectangles_of(const ColumnMap& plan, std::size_t profile) {
  std::vector<Rectangle> done;
  std::map<std::pair<int, int>, Rectangle> open;  // by the ends of a run in the row above
  for (int row = 0; row < plan.rows(); ++row) {
    std::map<std::pair<int, int>, Rectangle> next;
    for (int column = 0; column < plan.columns(); ++column) {
      if (plan.profile_of_pixel.at(row, column) != profile) continue;
      const int left = column;
      while (column < plan.columns() && plan.profile_of_pixel.at(row, column) == profile) ++column;
      const auto above = open.extract({left, column});
      Rectangle rectangle = above ? above.mapped() : Rectangle{row, row, left, column};
      rectangle.bottom = row + 1;
      next.emplace(std::pair(left, column), rectangle);
    }
    for (const auto& [ends, rectangle] : open) done.push_back(rectangle);
    open = std::move(next);
  }
  for (const auto& [ends, rectangle] : open) done.push_back(rectangle);
  return done;
}

std::string polygon_text(const ColumnMap& plan, const Rectangle& rectangle) {
  const auto corner = [&](int column, int row) {
    const Eigen::Vector2d point =
        plan.map_from_plan(column * plan.resolution_m, (plan.rows() - row) * plan.resolution_m);
    return fmt::format("[{}, {}]", point.x(), point.y());
  };
  const std::array<std::string, 5> ring{corner(rectangle.left, rectangle.bottom),
                                        corner(rectangle.right, rectangle.bottom),
                                        corner(rectangle.right, rectangle.top),
                                        corner(rectangle.left, rectangle.top),
                                        corner(rectangle.left, rectangle.bottom)};
  return fmt::format("[[{}]]", fmt::join(ring, ", "));
}

std::string in_quotes(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string feature_text(const ColumnMap& plan, std::size_t profile, const MapClass& own) {
  std::vector<std::string> polygons;
  for (const Rectangle& rectangle : rectangles_of(plan, profile)) {
    polygons.push_back("        " + polygon_text(plan, rectangle));
  }
  return fmt::format(
      "    {{\"type\": \"Feature\", \"properties\": {{\"class\": {}, \"min_height\": {}, "
      "\"max_height\": {}, \"below\": {}, \"above\": {}}},\n"
      "      \"geometry\": {{\"type\": \"MultiPolygon\", \"coordinates\": [\n{}]}}}}",
      in_quotes(own.name),
      own.min_height_m,
      own.max_height_m,
      in_quotes(own.below.empty() ? "none" : own.below),
      in_quotes(own.above.empty() ? "none" : own.above),
      fmt::join(polygons, ",\n"));
}

}  // namespace

std::string objects_text(const SemanticMap& map) {
  const ColumnMap& plan = *map.columns();
  const std::size_t first = plan.profiles.size() - map.objects.profiles.size();
  std::vector<bool> seen(plan.profiles.size(), false);
  for (const std::uint8_t profile : plan.profile_of_pixel.pixels()) seen[profile] = true;
  std::vector<std::string> features;
  for (std::size_t i = 0; i < map.objects.profiles.size(); ++i) {
    if (seen[first + i]) features.push_back(feature_text(plan, first + i, map.objects.profiles[i]));
  }
  if (features.empty()) return {};
  return fmt::format("{{\n  \"type\": \"FeatureCollection\",\n  \"features\": [\n{}\n  ]\n}}\n",
                     fmt::join(features, ",\n"));
}

}  // namespace semview::map::detail
