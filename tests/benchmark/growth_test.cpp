// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/growth.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace semview::benchmark {
namespace {

TEST(GrowthTest, EachParameterIsVariedAndFilesHoldAllPoints) {
  GrowthConfig config;
  config.quick = true;
  const auto points = measure_growth(config, [](std::size_t, std::size_t) {});
  ASSERT_TRUE(points) << points.error().message;
  std::set<std::string> parameters;
  for (const GrowthPoint& point : *points) {
    parameters.insert(point.parameter);
    EXPECT_GT(point.triangles, 0U);
    EXPECT_GT(point.stored_bytes, 0.0);
  }
  EXPECT_EQ(parameters, (std::set<std::string>{"area_m2", "classes", "columns", "pixel_cm"}));
  const std::string csv = to_csv(*points);
  EXPECT_EQ(std::ranges::count(csv, '\n'), static_cast<std::ptrdiff_t>(points->size()) + 1);
  const semview::testing::TemporaryFolder folder;
  ASSERT_TRUE(write_growth_svg(folder / "growth.svg", *points));
  std::ifstream file(folder / "growth.svg");
  const std::string svg(std::istreambuf_iterator<char>(file), {});
  EXPECT_THAT(svg, ::testing::HasSubstr("</svg>"));
}

TEST(GrowthTest, AFileThatCannotBeWrittenIsAnError) {
  GrowthPoint point;
  point.parameter = "classes";
  point.value = point.columns_us = point.packets_us = point.compass_us = 1.0;
  EXPECT_FALSE(write_growth_svg("/nowhere/growth.svg", std::vector{point}));
}

}  // namespace
}  // namespace semview::benchmark
