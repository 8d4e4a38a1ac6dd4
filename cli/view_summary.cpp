// SPDX-License-Identifier: Apache-2.0
#include "view_summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "semview/core/hash.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/eye_place.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::cli {
namespace {

using nlohmann::ordered_json;

/// What keeps the eye from seeing the map as a robot would, or an empty text.
std::string eye_trouble(const service::Site& site, const Pose2& pose, double eye_z_m) {
  const map::ColumnMap* columns = site.map().columns();
  if (columns == nullptr) {
    const auto cell = PoseGrid::cell(pose.x_m, pose.y_m);
    return cell && site.cells().has_eye(*cell) ? "" : "the eye is inside something or outside";
  }
  const map::EyePlace place = map::eye_place(*columns, pose.x_m, pose.y_m, eye_z_m);
  if (place.outside) return "the eye is outside the building";
  if (place.in_slab) {
    return fmt::format("the eye is inside a {}", site.map().classes.name(*place.in_slab));
  }
  return place.above_ceiling ? "the eye is above the ceiling" : "";
}

ordered_json class_shares(const View& view, const ClassTable& classes) {
  std::array<std::size_t, 256> counts{};
  for (const ClassId label : view.labels.pixels()) ++counts[label];
  const auto pixels = static_cast<double>(view.labels.pixels().size());
  ordered_json shares = ordered_json::array();
  for (std::size_t id = 0; id < counts.size(); ++id) {
    if (counts[id] == 0) continue;
    shares.push_back({{"id", id},
                      {"name", std::string(classes.name(static_cast<ClassId>(id)))},
                      {"pixels", counts[id]},
                      {"share", static_cast<double>(counts[id]) / pixels}});
  }
  std::stable_sort(shares.begin(), shares.end(), [](const auto& a, const auto& b) {
    return a["pixels"].template get<std::size_t>() > b["pixels"].template get<std::size_t>();
  });
  return shares;
}

ordered_json camera_json(const View& view) {
  ordered_json camera{{"kind", view.panorama ? "panorama" : "pinhole"},
                      {"columns", view.labels.columns()},
                      {"rows", view.labels.rows()}};
  if (view.panorama) {
    camera["elevation_deg"] = {deg_from_rad(view.panorama->elevation_min_rad),
                               deg_from_rad(view.panorama->elevation_max_rad)};
  }
  return camera;
}

}  // namespace

ViewedMap viewed_map(const service::Site& site, const Pose2& pose, double eye_z_m) {
  const map::SemanticMap& map = site.map();
  return {
      site.id(), map.name, map.fingerprint, map.classes, eye_z_m, eye_trouble(site, pose, eye_z_m)};
}

ordered_json view_summary(const ViewedMap& map, const Pose2& pose, const View& view) {
  ordered_json result{
      {"map", map.id},
      {"fingerprint", to_hex(map.fingerprint)},
      {"engine", view.engine.name},
      {"engine_reason", view.engine.reason},
      {"pose", {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"yaw_deg", deg_from_rad(pose.yaw_rad)}}},
      {"eye_z_m", map.eye_z_m},
      {"camera", camera_json(view)},
      {"cast_ms", view.cast_ms}};
  const float nearest_m = *std::ranges::min_element(view.distances_m.pixels());
  const char* const nearest = view.panorama ? "nearest_range_m" : "nearest_depth_m";
  result[nearest] = std::isfinite(nearest_m) ? ordered_json(nearest_m) : ordered_json(nullptr);
  result["classes"] = class_shares(view, map.classes);
  if (!map.eye_trouble.empty()) result["warning"] = map.eye_trouble;
  return result;
}

void print_view_summary(const ordered_json& view) {
  const ordered_json& pose = view["pose"];
  fmt::print("{} from ({:g}, {:g}) at {:g}°, eye at z {:g} m: {} x {} {} by {} in {:.2f} ms\n",
             view["map"].get<std::string>(),
             pose["x_m"].get<double>(),
             pose["y_m"].get<double>(),
             pose["yaw_deg"].get<double>(),
             view["eye_z_m"].get<double>(),
             view["camera"]["columns"].get<int>(),
             view["camera"]["rows"].get<int>(),
             view["camera"]["kind"].get<std::string>(),
             view["engine"].get<std::string>(),
             view["cast_ms"].get<double>());
  for (const ordered_json& entry : view["classes"]) {
    fmt::print("{:>5}  {:<16} {:5.1f} %\n",
               entry["id"].get<int>(),
               entry["name"].get<std::string>(),
               100.0 * entry["share"].get<double>());
  }
}

}  // namespace semview::cli
