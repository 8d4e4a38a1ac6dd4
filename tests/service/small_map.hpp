// SPDX-License-Identifier: Apache-2.0
/// A map of two rooms with a door between them, drawn by the test itself.
#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include <gtest/gtest.h>

#include "semview/io/png.hpp"
#include "support/temporary_folder.hpp"

namespace semview::testing {

/// Writes the bundle `name` into `folder`; one character is 10 cm × 10 cm: `#` wall, `D` door (from
/// the floor to 2.1 m), `T` table, `.` floor, space outside. `wall_height` is text for map.yaml.
inline std::filesystem::path write_small_map(const TemporaryFolder& folder,
                                             std::string_view name = "two_rooms",
                                             std::string_view wall_height = "2.6") {
  constexpr std::array<std::string_view, 12> kPlan = {
      "####################",
      "#........#.........#",
      "#........#.........#",
      "#........#....TT...#",
      "#........D....TT...#",
      "#........D.........#",
      "#........#.........#",
      "#........#.........#",
      "####################",
      "#....#              ",
      "#....#              ",
      "######              ",
  };
  RgbImage labels(static_cast<int>(kPlan.size()), static_cast<int>(kPlan[0].size()));
  for (int r = 0; r < labels.rows(); ++r) {
    for (int c = 0; c < labels.columns(); ++c) {
      Rgb color{0, 0, 0};
      switch (kPlan[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)]) {
        case '#':
          color = {120, 120, 120};
          break;
        case 'D':
          color = {8, 255, 51};
          break;
        case 'T':
          color = {255, 6, 82};
          break;
        case '.':
          color = {80, 50, 50};
          break;
        default:
          break;
      }
      labels.at(r, c) = color;
    }
  }
  const std::filesystem::path directory = folder.path() / name;
  std::filesystem::create_directories(directory);
  EXPECT_TRUE(io::write_png(directory / "labels.png", labels).has_value());
  std::ofstream(directory / "map.yaml")
      << "image: occupancy.png\nresolution: 0.1\norigin: [-0.5, 0.2, 0.0]\nnegate: 0\n"
         "occupied_thresh: 0.65\nfree_thresh: 0.196\nsemview:\n  format: 1\n  labels: labels.png\n"
         "  ceiling: {class: ceiling, height: 2.6}\n  ground: {class: floor, height: 0.0}\n"
         "  outside: [0, 0, 0]\n  classes:\n    - {name: ceiling}\n"
         "    - {name: floor, color: [80, 50, 50], min_height: 0.0, max_height: 0.0}\n"
         "    - {name: wall, color: [120, 120, 120], min_height: 0.0, max_height: "
      << wall_height
      << "}\n    - {name: door, color: [8, 255, 51], min_height: 0.0, max_height: 2.1, above: "
         "wall}\n    - {name: table, color: [255, 6, 82], min_height: 0.70, max_height: 0.75}\n";
  return directory;
}

}  // namespace semview::testing
