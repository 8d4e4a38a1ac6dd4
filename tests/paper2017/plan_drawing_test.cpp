// SPDX-License-Identifier: Apache-2.0
/// What is drawn of a floor is a map without a complaint.
#include "experiments/paper2017/plan_drawing.hpp"

#include <gtest/gtest.h>

#include "semview/io/png.hpp"
#include "semview/map/map_checker.hpp"
#include "semview/map/semantic_map.hpp"
#include "support/temporary_folder.hpp"

namespace semview::paper2017 {
namespace {

using semview::testing::TemporaryFolder;

constexpr ClassSubset kSubsets[] = {ClassSubset::kAll,
                                    ClassSubset::kConstructionExtended,
                                    ClassSubset::kConstructionBasic,
                                    ClassSubset::kFurniture};

TEST(PlanDrawingTest, EverySubsetLoadsAndChecksClean) {
  const TemporaryFolder folder;
  const Layout layout = draw_layout({}, 1);
  for (const ClassSubset subset : kSubsets) {
    for (const bool stacked : {false, true}) {
      const auto place = folder / (std::string(name(subset)) + (stacked ? "s" : "p"));
      ASSERT_TRUE(draw_plan(
          layout, {.resolution_m = 0.04, .stacked = stacked, .classes = subset}, 1, place));
      const auto map = map::load_map(place);
      ASSERT_TRUE(map) << map.error().message;
      for (const std::string& name : map_class_names()) {
        EXPECT_EQ(map->classes.id(name).has_value(), has_class(subset, name) || name == "floor")
            << name;
      }
      for (const map::MapProblem& problem : map::check_map(place).report.problems) {
        EXPECT_NE(problem.severity, map::Severity::kError) << to_string(problem);
      }
    }
  }
}

TEST(PlanDrawingTest, EqualSeedsDrawEqualLinesWhateverIsLeftOut) {
  const TemporaryFolder folder;
  const Layout layout = draw_layout({}, 2);
  const PlanConfig all{.resolution_m = 0.04};
  PlanConfig basic = all;
  basic.classes = ClassSubset::kConstructionBasic;
  ASSERT_TRUE(draw_plan(layout, all, 2, folder / "one"));
  ASSERT_TRUE(draw_plan(layout, all, 2, folder / "two"));
  ASSERT_TRUE(draw_plan(layout, all, 3, folder / "other"));
  ASSERT_TRUE(draw_plan(layout, basic, 2, folder / "basic"));
  const auto image = [&](const char* name) {
    return *io::read_png_rgb(folder / name / "labels.png");
  };
  EXPECT_EQ(image("one"), image("two"));
  EXPECT_FALSE(image("one") == image("other"));
  // Where the basic plan has a wall, the full one has it too, or a window or door in it.
  const Rgb wall{120, 120, 120};
  const RgbImage full = image("one");
  const RgbImage few = image("basic");
  int walls = 0;
  for (int row = 0; row < few.rows(); ++row) {
    for (int column = 0; column < few.columns(); ++column) {
      if (!(full.at(row, column) == wall)) continue;
      ++walls;
      EXPECT_EQ(few.at(row, column), wall);
    }
  }
  EXPECT_GT(walls, 1000);
}

}  // namespace
}  // namespace semview::paper2017
