// SPDX-License-Identifier: Apache-2.0
/// Two furnished rooms of 4 m × 4 m with a door between them, 10 cm a pixel.
#pragma once

#include <string>
#include <vector>

#include "mesh/text_plan.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::simulation {

inline map::SemanticMap two_rooms() {
  map::SemanticMap map;
  map.id = "two_rooms";
  map.classes = ClassTable({"ceiling", "floor", "wall", "door", "table", "chair"});
  for (const std::string& name : map.classes.names()) {
    map::MapClass details;
    details.name = name;
    details.movable = name == "table" || name == "chair" ? 0.5 : 0.0;
    map.class_details.push_back(details);
  }
  map.ground_label = 2;
  map.ceiling = map::Ceiling{1, 2.6};
  std::vector<std::string> rows(42, "#" + std::string(40, '.') + "#" + std::string(40, '.') + "#");
  rows.front() = rows.back() = std::string(83, '#');
  for (int r = 16; r < 26; ++r) rows[static_cast<std::size_t>(r)][41] = 'd';
  for (std::size_t r = 4; r < 9; ++r) rows[r].replace(5, 9, "ttttttttt");
  for (std::size_t r = 30; r < 34; ++r) {
    for (std::size_t c = 50; c < 75; c += 8) rows[r].replace(c, 4, "cccc");
  }
  map::ColumnMap plan = map::plan_from_text(
      rows,
      {{'.', {.ground = 2, .slabs = {}}},
       {'#', {.ground = 2, .slabs = {{0.0, 2.6, 3}}}},
       {'d', {.passable = true, .ground = 2, .slabs = {{0.0, 2.1, 4}, {2.1, 2.6, 3}}}},
       {'t', {.ground = 2, .slabs = {{0.7, 0.75, 5}}}},
       {'c', {.ground = 2, .slabs = {{0.0, 0.9, 6}}}}},
      0.1);
  plan.ceiling = map.ceiling;
  map.geometry = std::move(plan);
  return map;
}

}  // namespace semview::simulation
