// SPDX-License-Identifier: Apache-2.0
// Every row of `semview bench`, quickly: whether results agree. None looks at a time.
#include "semview/benchmark/suite.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/io/png.hpp"
#include "support/temporary_folder.hpp"

namespace semview::benchmark {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(SuiteTest, ResultsAgreeInEveryRowOrItsPeerIsNotInstalled) {
  SuiteConfig config;
  config.quick = true;
  std::size_t announced = 0;
  const auto rows = run_suite(config, [&](const Progress&) { ++announced; });
  ASSERT_TRUE(rows) << rows.error().message;
  EXPECT_EQ(announced, rows->size());
  std::set<std::string> ids;
  for (const Row& row : *rows) {
    ids.insert(row.id);
    EXPECT_FALSE(row.disagrees) << row.id << " at " << row.size << ": " << row.note;
    if (!row.found) {
      EXPECT_THAT(row.note, StartsWith("not installed: ")) << row.id;
    }
  }
  EXPECT_EQ(ids.size(), claims().size());
}

TEST(SuiteTest, RowsAreChosenByName) {
  SuiteConfig config;
  config.quick = true;
  config.only = {"bytes"};
  const auto rows = run_suite(config, [](const Progress&) {});
  ASSERT_TRUE(rows);
  ASSERT_EQ(rows->size(), 1U);
  EXPECT_EQ(rows->front().id, "bytes");
}

TEST(SuiteTest, LabelsAloneSayNothingOfRangesAndPrecomputeNamesItsEngine) {
  SuiteConfig config;
  config.quick = true;
  config.threads = {1};
  config.engine = "embree";
  config.only = {"labels", "precompute", "precompute_embree", "ready"};
  const auto rows = run_suite(config, [](const Progress&) {});
  ASSERT_TRUE(rows);
  for (const Row& row : *rows) {
    ASSERT_TRUE(row.found) << row.id << ": " << row.note;
    if (row.id == "labels") {
      EXPECT_THAT(row.found->agreement, Not(HasSubstr("ranges")));
      EXPECT_EQ(row.engine, "") << "it opens no map as the service does";
      EXPECT_EQ(row.found->clock, "thread");
    } else {
      EXPECT_EQ(row.engine, row.id == "precompute" ? "columns" : "embree");
      EXPECT_NE(row.engine_reason, "");
      EXPECT_THAT(row.found->agreement, HasSubstr(row.engine));
    }
  }
}

TEST(SuiteTest, WhatCannotBeMeasuredIsRefusedByItsOption) {
  SuiteConfig config;
  config.only = {"telepathy"};
  const auto unknown = run_suite(config, [](const Progress&) {});
  EXPECT_EQ(unknown.error().field, "--only");
  EXPECT_THAT(unknown.error().message, HasSubstr("no such row; there are single, "));
  config.only.clear();
  config.threads = {0};
  EXPECT_EQ(run_suite(config, [](const Progress&) {}).error().field, "--threads");
  config.engine = "steam";
  EXPECT_EQ(run_suite(config, [](const Progress&) {}).error().field, "--engine");
}

TEST(SuiteTest, APlanThatCannotBeMeasuredCostsItsOwnRowsOnlyAndIsNamed) {
  const semview::testing::TemporaryFolder folder;
  for (const auto& [name, color] :
       std::map<std::string, Rgb>{{"all_outside", {0, 0, 0}}, {"one_wall", {120, 120, 120}}}) {
    std::filesystem::create_directory(folder / name);
    ASSERT_TRUE(io::write_png(folder / name / "labels.png", RgbImage(8, 8, color)));
    std::ofstream(folder / name / "map.yaml")
        << "image: labels.png\nresolution: 0.1\norigin: [0.0, 0.0, 0.0]\nnegate: 0\n"
           "occupied_thresh: 0.65\nfree_thresh: 0.196\nsemview:\n  format: 1\n"
           "  labels: labels.png\n  ground: {class: floor, height: 0.0}\n  outside: [0, 0, 0]\n"
           "  classes:\n    - {name: floor, color: [80, 50, 50], min_height: 0.0, max_height: "
           "0.0}\n"
           "    - {name: wall, color: [120, 120, 120], min_height: 0.0, max_height: 2.6}\n";
  }
  SuiteConfig config;
  config.quick = true;
  config.threads = {1};
  config.only = {"bytes"};
  config.maps = {folder / "all_outside", folder / "one_wall"};
  const auto rows = run_suite(config, [](const Progress&) {});
  ASSERT_TRUE(rows) << rows.error().message;
  ASSERT_EQ(rows->size(), 3U);
  EXPECT_TRUE((*rows)[0].found);
  EXPECT_FALSE((*rows)[0].failed);
  EXPECT_TRUE((*rows)[1].failed);
  EXPECT_FALSE((*rows)[1].disagrees);
  EXPECT_THAT((*rows)[1].note, HasSubstr("all_outside: there is no surface to see"));
  EXPECT_TRUE((*rows)[2].failed);
  EXPECT_THAT((*rows)[2].note, HasSubstr("one_wall: no free cell"));
}

TEST(SuiteTest, WithoutATemporaryFolderARowFailsAndSaysSo) {
  const char* const before = std::getenv("TMPDIR");
  const std::optional<std::string> kept =
      before == nullptr ? std::nullopt : std::optional<std::string>(before);
  ::setenv("TMPDIR", "/nowhere", 1);
  SuiteConfig config;
  config.quick = true;
  config.threads = {1};
  config.only = {"precompute"};
  const auto rows = run_suite(config, [](const Progress&) {});
  kept ? ::setenv("TMPDIR", kept->c_str(), 1) : ::unsetenv("TMPDIR");
  ASSERT_TRUE(rows);
  ASSERT_EQ(rows->size(), 1U);
  EXPECT_TRUE(rows->front().failed);
  EXPECT_THAT(rows->front().note, HasSubstr("no folder for temporary files"));
}

TEST(SuiteTest, WhoStopsItHasTheRowsSoFar) {
  SuiteConfig config;
  config.quick = true;
  config.threads = {1};
  config.only = {"bytes", "held"};
  int asked = 0;
  config.stopped = [&asked] { return ++asked > 1; };
  const auto rows = run_suite(config, [](const Progress&) {});
  ASSERT_TRUE(rows);
  EXPECT_EQ(rows->size(), 1U);
}

}  // namespace
}  // namespace semview::benchmark
