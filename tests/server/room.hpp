// SPDX-License-Identifier: Apache-2.0
/// A small room as a map bundle on disk, and sites of it, for tests of server and client.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "semview/geometry/image.hpp"
#include "semview/io/png.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/service/map_registry.hpp"
#include "semview/service/site.hpp"
#include "semview/view/observation.hpp"
#include "support/engine_wish.hpp"
#include "support/temporary_folder.hpp"

namespace semview::test {

using semview::testing::TemporaryFolder;

/// Writes a room of 4 m × 3 m, its lower-left corner at (0, 0), with walls of 0.1 m all around and
/// a table of 1 m × 0.5 m whose left edge stands at `table_x_m`.
inline std::filesystem::path write_room(const std::filesystem::path& parent,
                                        const std::string& id,
                                        double table_x_m = 1.0) {
  constexpr int kRows = 60;
  constexpr int kColumns = 80;
  const Rgb floor{80, 50, 50};
  const Rgb wall{120, 120, 120};
  const Rgb table{255, 6, 82};
  RgbImage labels(kRows, kColumns, floor);
  const int table_column = static_cast<int>(table_x_m * 20.0);
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kColumns; ++c) {
      const bool border = r < 2 || c < 2 || r >= kRows - 2 || c >= kColumns - 2;
      const bool on_table = r >= 20 && r < 30 && c >= table_column && c < table_column + 20;
      if (border) labels.at(r, c) = wall;
      if (on_table) labels.at(r, c) = table;
    }
  }
  const std::filesystem::path folder = parent / id;
  std::filesystem::create_directories(folder);
  EXPECT_TRUE(io::write_png(folder / "labels.png", labels));
  std::ofstream(folder / "map.yaml") << R"(
resolution: 0.05
origin: [0.0, 0.0, 0.0]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
semview:
  format: 1
  name: )" << id << R"(
  labels: labels.png
  ceiling: {class: ceiling, height: 2.5}
  ground: {class: floor, height: 0.0}
  outside: [0, 0, 0]
  classes:
    - {name: ceiling}
    - {name: floor, color: [80, 50, 50], min_height: 0.0, max_height: 0.0}
    - {name: wall, color: [120, 120, 120], min_height: 0.0, max_height: 2.5}
    - {name: table, color: [255, 6, 82], min_height: 0.7, max_height: 0.75}
)";
  return folder;
}

/// Small panoramas: casting them takes next to nothing.
inline service::SiteConfig small_sites() {
  service::SiteConfig config;
  config.profile.camera.columns = 120;
  config.profile.camera.rows = 30;
  config.threads = 2;
  config.engine = testing::engine_wish();
  return config;
}

/// As semview-server has them by default.
inline service::SiteConfig default_sites() {
  service::SiteConfig config;
  config.engine = testing::engine_wish();
  return config;
}

inline std::shared_ptr<service::Site> open_site(const std::filesystem::path& folder,
                                                const std::string& id = {},
                                                const service::SiteConfig& config = small_sites()) {
  auto tiers = service::SharedTiers::open(config);
  EXPECT_TRUE(tiers) << tiers.error().message;
  auto site = service::Site::open(folder, id, config, *tiers);
  EXPECT_TRUE(site) << site.error().message;
  return *site;
}

inline service::MapRegistry registry_of(const std::vector<std::shared_ptr<service::Site>>& sites) {
  service::MapRegistry maps;
  for (const auto& site : sites) EXPECT_TRUE(maps.add(site));
  return maps;
}

/// An observation as it would be made at a pose in the room: the view itself.
inline Observation observation_at(const service::Site& site, const Pose2& pose) {
  const auto key = PoseGrid::key(pose);
  const auto views = site.views().views(std::vector{key->cell});
  EXPECT_TRUE(views);
  LabelImage labels = views->views.front()->to_labels(key->heading);
  for (ClassId& label : labels.pixels()) label = label == kNoHit ? kUnknown : label;
  return {site.map().classes, std::move(labels), 0.0};
}

/// Poses all over the room and a little beyond it, the same ones always.
inline std::vector<Pose2> many_poses(std::size_t count) {
  std::vector<Pose2> poses(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto t = static_cast<double>(i);
    poses[i] = {-0.5 + 5.0 * std::fmod(t * 0.618034, 1.0),
                -0.5 + 4.0 * std::fmod(t * 0.754878, 1.0),
                wrap_angle(t * 0.7)};
  }
  return poses;
}

}  // namespace semview::test
