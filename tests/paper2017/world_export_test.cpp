// SPDX-License-Identifier: Apache-2.0
#include "experiments/paper2017/world_export.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/paper2017/export_folder.hpp"
#include "experiments/paper2017/row_map.hpp"
#include "semview/map/semantic_map.hpp"
#include "support/temporary_folder.hpp"

namespace semview::paper2017 {
namespace {

using ::testing::HasSubstr;

void say_nothing(std::size_t /*done*/, std::size_t /*all*/) {}

ExperimentConfig of_worlds(const std::vector<std::uint64_t>& worlds) {
  ExperimentConfig config;
  config.rows = {"shear_0.3"};
  config.worlds = worlds;
  return config;
}

TEST(WorldExportTest, TheMapIsTheOneThatTheRowIsLocalizedOn) {
  const testing::TemporaryFolder folder;
  const ExperimentConfig config = of_worlds({101});  // training worlds may be given away
  const Status exported = export_worlds(config, folder / "out", say_nothing);
  ASSERT_TRUE(exported) << exported.error().message;
  const World world = make_world(config.world, WorldSeeds::all(101));
  const Row& row = *find_row("shear_0.3");
  for (const bool stacked : {false, true}) {
    ASSERT_TRUE(draw_world_plan(world.layout, 101, row.classes, stacked, folder / "plans"));
    const auto site = open_row_map(row, 101, stacked, folder / "plans", "embree");
    ASSERT_TRUE(site) << site.error().message;
    const auto map = map::load_map(folder / "out" / "input/shear_0.3/world_101" /
                                   (stacked ? "map_stacked" : "map"));
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_EQ(map->fingerprint, (*site)->map().fingerprint);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "plans"));
}

TEST(WorldExportTest, NothingIsWrittenOverOrMixed) {
  const testing::TemporaryFolder folder;
  const auto message = [&](const std::vector<std::uint64_t>& worlds) {
    const Status exported = export_worlds(of_worlds(worlds), folder / "out", say_nothing);
    return exported ? "" : exported.error().message;
  };
  EXPECT_THAT(message({100, 101}), HasSubstr("weights are learned on world 101"));
  EXPECT_THAT(message({7, 201}), HasSubstr("expected one kind"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  std::filesystem::create_directories(folder / "out" / "input");
  EXPECT_THAT(message({1}), HasSubstr("holds an export already"));
}

TEST(WorldExportTest, WhatWasStoppedIsMadeAgainAndNeverLooksWhole) {
  const testing::TemporaryFolder folder;
  const auto stopped = ExportFolder::begin(folder / "out");
  ASSERT_TRUE(stopped) << stopped.error().message;
  std::filesystem::create_directories(stopped->unfinished() / "input" / "half a map");
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "input"));
  const Status exported = export_worlds(of_worlds({101}), folder / "out", say_nothing);
  ASSERT_TRUE(exported) << exported.error().message;
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "input" / "list.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "input" / "half a map"));
  EXPECT_FALSE(std::filesystem::exists(stopped->unfinished()));
}

}  // namespace
}  // namespace semview::paper2017
