// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/office_plan.hpp"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/map/cell_grid.hpp"
#include "support/temporary_folder.hpp"

namespace semview::benchmark {
namespace {

constexpr OfficePlan kSmall{15.0, 12.5, 0.05, 11, 1};

TEST(OfficePlanTest, EqualValuesGiveEqualPlansAndAnotherSeedAnotherOne) {
  OfficePlan other = kSmall;
  other.seed = 2;
  EXPECT_EQ(draw_office(kSmall)->fingerprint, draw_office(kSmall)->fingerprint);
  EXPECT_NE(draw_office(kSmall)->fingerprint, draw_office(other)->fingerprint);
}

TEST(OfficePlanTest, ItsBundleIsTheSameMap) {
  const semview::testing::TemporaryFolder folder;
  ASSERT_TRUE(write_office(kSmall, folder / "office"));
  const auto loaded = map::load_map(folder / "office");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->fingerprint, draw_office(kSmall)->fingerprint);
}

TEST(OfficePlanTest, EveryClassIsSeenSomewhereAndMostCellsAreFree) {
  for (const int classes : {7, 11, 20}) {
    OfficePlan plan{40.0, 25.0, 0.05, classes, 1};
    const auto office = draw_office(plan);
    ASSERT_TRUE(office);
    EXPECT_EQ(office->classes.size(), classes);
    const auto pixels = office->columns()->profile_of_pixel.pixels();
    // One profile a class, but for ceiling (2) and outside (0).
    EXPECT_EQ(std::set<int>(pixels.begin(), pixels.end()).size(),
              static_cast<std::size_t>(classes) - 1);
    const map::CellGrid cells = map::build_cell_grid(*office->columns(), 1.2);
    EXPECT_GT(cells.free_count(), 60'000U);
    EXPECT_GT(cells.components().front().cells, cells.free_count() * 4 / 5) << "no way through";
  }
}

TEST(OfficePlanTest, FinerPixelsShowTheSamePlan) {
  OfficePlan fine = kSmall;
  fine.resolution_m = 0.025;
  const auto coarse_map = draw_office(kSmall);
  const auto fine_map = draw_office(fine);
  std::size_t same = 0;
  const auto& coarse_pixels = coarse_map->columns()->profile_of_pixel;
  for (int r = 0; r < coarse_pixels.rows(); ++r) {
    for (int c = 0; c < coarse_pixels.columns(); ++c) {
      if (coarse_pixels.at(r, c) == fine_map->columns()->profile_of_pixel.at(2 * r, 2 * c)) ++same;
    }
  }
  EXPECT_GT(static_cast<double>(same), 0.97 * static_cast<double>(coarse_pixels.pixels().size()));
}

TEST(OfficePlanTest, PlansThatAreNoneAreRefused) {
  const auto message = [](const OfficePlan& plan) { return draw_office(plan).error().message; };
  EXPECT_THAT(message({1.0, 25.0, 0.05, 11, 1}), ::testing::HasSubstr("sides of 5 to 2000 m"));
  EXPECT_THAT(message({40.0, 25.0, 0.0, 11, 1}), ::testing::HasSubstr("0.005 to 0.2"));
  EXPECT_THAT(message({2000.0, 2000.0, 0.05, 11, 1}), ::testing::HasSubstr("at most 4e8"));
  EXPECT_THAT(message({40.0, 25.0, 0.05, 6, 1}), ::testing::HasSubstr("expected 7 to 120"));
}

}  // namespace
}  // namespace semview::benchmark
