// SPDX-License-Identifier: Apache-2.0
/// Reads one GeoJSON feature and collects what is wrong with it. Inside the module only.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "semview/map/map_object.hpp"
#include "semview/map/map_problem.hpp"

namespace semview::map::detail {

/// The value of a member of an object; null for none, and if `value` is no object or it is null.
const nlohmann::json* member(const nlohmann::json& value, const char* key);

class ObjectFields {
 public:
  /// `points_left`: how many points the file may still have.
  ObjectFields(const nlohmann::json& feature,
               int number,
               std::filesystem::path file,
               std::size_t points_left,
               MapReport& report);

  /// None: it has an error, or no geometry.
  std::optional<MapObject> read();
  std::size_t points() const { return points_; }

 private:
  void warn_of_misspelt(const nlohmann::json& properties);
  void read_properties(const nlohmann::json& properties);
  std::optional<double> height(const nlohmann::json& properties, const char* key);
  std::optional<std::string> filler(const nlohmann::json& properties, const char* key);
  void read_over(const nlohmann::json& value);
  void read_geometry(const nlohmann::json& geometry);
  void read_polygon(const nlohmann::json& rings);
  std::optional<Ring> read_ring(const nlohmann::json& positions);
  std::optional<Eigen::Vector2d> read_position(const nlohmann::json& position);

  void add(Severity severity, std::string message, std::string remedy);
  void error(std::string message, std::string remedy);

  const nlohmann::json& feature_;
  std::filesystem::path file_;
  std::size_t points_left_;
  MapReport& report_;
  MapObject object_;
  std::size_t points_ = 0;
  bool refused_ = false;
};

}  // namespace semview::map::detail
