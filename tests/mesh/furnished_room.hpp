// SPDX-License-Identifier: Apache-2.0
/// A small room with a door, a window and a table, as a whole map.
#pragma once

#include "mesh/text_plan.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::map {

inline SemanticMap furnished_room() {
  SemanticMap map;
  map.id = "room";
  map.name = "Room";
  const std::vector<std::pair<const char*, Rgb>> classes{{"ceiling", {120, 120, 80}},
                                                         {"floor", {80, 50, 50}},
                                                         {"wall", {120, 120, 120}},
                                                         {"door", {8, 255, 51}},
                                                         {"window", {230, 230, 230}},
                                                         {"table", {255, 6, 82}}};
  std::vector<std::string> names;
  for (const auto& [name, color] : classes) {
    names.emplace_back(name);
    MapClass details;
    details.name = name;
    details.color = color;
    map.class_details.push_back(details);
  }
  map.classes = ClassTable(names);
  map.ground_label = 2;
  map.ceiling = Ceiling{1, 2.5};
  ColumnMap plan =
      plan_from_text({"#####w####", "#........#", "#...tt...#", "#........#", "####d#####"},
                     {{'.', {.ground = 2, .slabs = {}}},
                      {'#', {.ground = 2, .slabs = {{0.0, 2.5, 3}}}},
                      {'d', {.ground = 2, .slabs = {{0.0, 2.1, 4}, {2.1, 2.5, 3}}}},
                      {'w', {.ground = 2, .slabs = {{0.0, 0.9, 3}, {0.9, 2.1, 5}, {2.1, 2.5, 3}}}},
                      {'t', {.ground = 2, .slabs = {{0.7, 0.75, 6}}}}},
                     0.4);
  plan.ceiling = map.ceiling;
  plan.origin = {-1.3, 2.7, 0.0};
  map.geometry = std::move(plan);
  return map;
}

}  // namespace semview::map
