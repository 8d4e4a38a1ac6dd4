// SPDX-License-Identifier: Apache-2.0
// Every row of `semview bench`, quickly: whether results agree. None looks at a time.
#include "semview/benchmark/suite.hpp"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
      EXPECT_EQ(row.found->clock, "thread");
    } else {
      EXPECT_THAT(row.found->agreement, HasSubstr(row.id == "precompute" ? "columns" : "embree"));
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

}  // namespace
}  // namespace semview::benchmark
