// SPDX-License-Identifier: Apache-2.0
/// Objects with heights of their own, as `objects.geojson` has them. Inside the module only.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "semview/map/map_problem.hpp"

namespace semview::map::detail {

/// Closed: the last point is the first. Metres in frame `map`.
using Ring = std::vector<Eigen::Vector2d>;

/// The outline, then its holes.
struct ObjectPolygon {
  std::vector<Ring> rings;
};

/// A feature of the file. What is absent is as in the class list.
struct MapObject {
  Feature feature;
  std::string class_name;
  std::optional<double> min_height_m;
  std::optional<double> max_height_m;
  std::optional<std::string> above;  ///< "": nothing
  std::optional<std::string> below;
  std::vector<std::string> over;  ///< what it may replace; empty: whatever is not outside
  std::vector<ObjectPolygon> polygons;
};

/// Reads the features of a GeoJSON file and adds all that is wrong in it to `report`; those that
/// have an error are left out. What takes the class list or the drawing is not checked.
std::vector<MapObject> read_objects(const std::filesystem::path& path, MapReport& report);

/// A point at which two edges of a polygon cross by more than a micrometre, if there is one. Rings
/// may touch.
std::optional<Eigen::Vector2d> crossing_in(const ObjectPolygon& polygon);

}  // namespace semview::map::detail
