// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "semview/map/cell_grid.hpp"
#include "semview/map/map_checker.hpp"
#include "support/paths.hpp"

namespace semview::map {
namespace {

std::vector<std::filesystem::path> shipped_maps() {
  std::vector<std::filesystem::path> folders;
  for (const auto& entry : std::filesystem::directory_iterator(SEMVIEW_SOURCE_DIR "/maps")) {
    if (entry.is_directory()) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

class ShippedMapTest : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(ShippedMapTest, PassesTheCheckUnderItsFoldersName) {
  const MapCheck check = check_map(GetParam());
  for (const MapProblem& problem : check.report.problems) {
    EXPECT_NE(problem.severity, Severity::kError) << to_string(problem);
  }
  ASSERT_TRUE(check.map);
  EXPECT_EQ(check.map->id, GetParam().filename().string());
}

TEST_P(ShippedMapTest, SaysWhereItComesFrom) {
  EXPECT_TRUE(std::filesystem::exists(GetParam() / "ATTRIBUTION.md"));
}

INSTANTIATE_TEST_SUITE_P(Maps,
                         ShippedMapTest,
                         ::testing::ValuesIn(shipped_maps()),
                         [](const auto& folder) { return folder.param.filename().string(); });

TEST(ShippedMapsTest, AreThoseThatTheReadmeNames) {
  std::set<std::string> names;
  for (const std::filesystem::path& folder : shipped_maps()) {
    names.insert(folder.filename().string());
  }
  for (const char* name :
       {"duplex_building", "duplex_level1", "duplex_level2", "largebuilding_level1", "tutorial"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
}

TEST(ShippedMapsTest, TheTutorialsHouseIsOneWholeWithoutWarnings) {
  EXPECT_TRUE(check_map(SEMVIEW_SOURCE_DIR "/maps/tutorial").report.problems.empty());
}

TEST(ShippedMapsTest, TheDuplexIsTwoApartmentsWithARobotsWorthOfFreeSpaceEach) {
  const Result<SemanticMap> map = load_map(SEMVIEW_SOURCE_DIR "/maps/duplex_level1");
  ASSERT_TRUE(map);
  const std::vector<GridComponent> parts = build_cell_grid(*map->columns(), 1.2).components();
  ASSERT_GE(parts.size(), 2U);
  EXPECT_GT(parts[0].cells, 5000U);
  EXPECT_GT(parts[1].cells, 5000U);
}

}  // namespace
}  // namespace semview::map
