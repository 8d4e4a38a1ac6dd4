// SPDX-License-Identifier: Apache-2.0
#include "map/bundle.hpp"

#include <atomic>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "semview/io/png.hpp"

namespace semview::map::testing {

TempFolder::TempFolder() {
  static std::atomic<int> counter{0};
  path_ = std::filesystem::temp_directory_path() /
          fmt::format("semview_map_test_{}_{}", ::getpid(), counter++);
  std::filesystem::create_directories(path_);
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

Rgb color_of(char c) {
  switch (c) {
    case '#':
      return {120, 120, 120};
    case '.':
      return {80, 50, 50};
    case 'D':
      return {8, 255, 51};
    case 'W':
      return {230, 230, 230};
    case 'T':
      return {255, 6, 82};
    case ' ':
      return {0, 0, 0};
    default:
      return {1, 2, 3};
  }
}

RgbImage drawing(const std::vector<std::string>& rows) {
  RgbImage image(static_cast<int>(rows.size()), static_cast<int>(rows[0].size()));
  for (int row = 0; row < image.rows(); ++row) {
    for (int column = 0; column < image.columns(); ++column) {
      image.at(row, column) =
          color_of(rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)]);
    }
  }
  return image;
}

std::string map_yaml() {
  return "image: occupancy.png\n"                                                        // line 1
         "resolution: 0.1\n"                                                             // 2
         "origin: [-1.0, 2.0, 0.0]\n"                                                    // 3
         "negate: 0\n"                                                                   // 4
         "semview:\n"                                                                    // 5
         "  format: 1\n"                                                                 // 6
         "  id: test_room\n"                                                             // 7
         "  name: Test room\n"                                                           // 8
         "  labels: labels.png\n"                                                        // 9
         "  ceiling: {class: ceiling, height: 2.6}\n"                                    // 10
         "  ground: {class: floor, height: 0.0}\n"                                       // 11
         "  outside: [0, 0, 0]\n"                                                        // 12
         "  classes:\n"                                                                  // 13
         "    - {name: ceiling}\n"                                                       // 14
         "    - {name: floor, color: [80, 50, 50], min_height: 0, max_height: 0}\n"      // 15
         "    - {name: wall, color: [120, 120, 120], min_height: 0, max_height: 2.6}\n"  // 16
         "    - {name: door, color: [8, 255, 51], min_height: 0, max_height: 2.1, above: wall}\n"
         "    - {name: window, color: [230, 230, 230], min_height: 0.9, max_height: 2.1, "  // 18
         "below: wall, above: wall}\n"
         "    - {name: table, color: [255, 6, 82], min_height: 0.7, max_height: 0.75, "  // 19
         "movable: 0.5, aliases: [desk]}\n";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return place == std::string::npos ? text : text.replace(place, from.size(), to);
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

void write_bundle(const std::filesystem::path& folder,
                  const std::vector<std::string>& rows,
                  const std::string& yaml) {
  std::filesystem::create_directories(folder);
  write_text(folder / "map.yaml", yaml);
  ASSERT_TRUE(io::write_png(folder / "labels.png", drawing(rows)));
}

std::vector<std::string> room() {
  return {"            ",
          " ####WW#### ",
          " #........# ",
          " #........# ",
          " #..TT....# ",
          " #..TT....D ",
          " #........D ",
          " #........# ",
          " ########## ",
          "            "};
}

ColumnMap columns(const std::vector<std::string>& rows, double resolution_m, const Pose2& origin) {
  const std::string kinds = " .#Dt";
  ColumnMap map;
  map.resolution_m = resolution_m;
  map.origin = origin;
  map.ceiling = Ceiling{9, 2.6};
  map.profiles = {ColumnProfile{true, false, kNoHit, {}},
                  ColumnProfile{false, false, 1, {}},
                  ColumnProfile{false, false, 1, {{0.0, 2.6, 2}}},
                  ColumnProfile{false, true, 1, {{0.0, 2.1, 3}, {2.1, 2.6, 2}}},
                  ColumnProfile{false, false, 1, {{0.7, 0.75, 4}}}};
  map.profile_of_pixel =
      Image<std::uint8_t>(static_cast<int>(rows.size()), static_cast<int>(rows[0].size()));
  for (int row = 0; row < map.rows(); ++row) {
    for (int column = 0; column < map.columns(); ++column) {
      const char kind = rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
      map.profile_of_pixel.at(row, column) = static_cast<std::uint8_t>(kinds.find(kind));
    }
  }
  return map;
}

}  // namespace semview::map::testing
