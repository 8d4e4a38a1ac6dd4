// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/table.hpp"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semview::benchmark {
namespace {

Row measured(double ours_s, double other_s, double ratio) {
  Row row;
  row.id = "pair";
  row.claim = "ours; theirs";
  row.subject = "office";
  row.size = "360x90";
  row.goal = {"at least 4x, then 5x", 4.0, 5.0};
  row.found =
      Finding{"s", ours_s, ours_s, other_s, other_s, ratio, ratio, 3, "thread", "labels equal"};
  return row;
}

TEST(TableTest, MarkdownHasARowAFindingAndSaysWhetherGoalsAreReached) {
  Row missing;
  missing.id = "pair";
  missing.claim = "ours; theirs";
  missing.subject = "hall";
  missing.size = "-";
  missing.note = "not installed: apt-get install it";
  const std::vector<Row> rows = {
      measured(1.23e-5, 0.00123, 100.0), measured(0.01, 0.0325, 3.25), missing};
  EXPECT_EQ(
      to_markdown(rows),
      "| row | claim | plan | size | threads | clock | ours | the alternative | ratio | goal | "
      "results |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n"
      "| pair | ours; theirs | office | 360x90 | 1 | thread | 12.3 us | 1.23 ms | 100x | at least "
      "4x, then 5x: yes, yes | "
      "labels equal |\n"
      "| pair | ours; theirs | office | 360x90 | 1 | thread | 10.0 ms | 32.5 ms | 3.25x | at least "
      "4x, then 5x: no, no | "
      "labels equal |\n"
      "| pair | ours; theirs | hall | - | 1 | - | - | - | - |  | not installed: apt-get install it "
      "|\n");
}

TEST(TableTest, TextIsAligned) {
  const std::string text = to_text(std::vector<Row>{measured(0.01, 0.0325, 3.25)});
  EXPECT_THAT(text,
              ::testing::HasSubstr(
                  "row   claim         plan    size    threads  clock   ours     the alternative"));
  EXPECT_THAT(text,
              ::testing::HasSubstr(
                  "pair  ours; theirs  office  360x90  1        thread  10.0 ms  32.5 ms"));
}

TEST(TableTest, AGoalMayBoundOurOwnFigure) {
  Row row = measured(0.8, 0.0, 0.0);
  row.goal = {"at most 1 s, then 0.5 s", 1.0, 0.5, true, true};
  EXPECT_EQ(row.reached(), true);
  EXPECT_EQ(row.reached_then(), false);
  row.found->ours = 1.1;
  EXPECT_EQ(row.reached(), false);
  row.found.reset();
  EXPECT_EQ(row.reached(), std::nullopt);
}

TEST(TableTest, FiguresHaveThreeDigits) {
  EXPECT_EQ(shown(0.0000004, "s"), "0.40 us");
  EXPECT_EQ(shown(0.000123, "s"), "123 us");
  EXPECT_EQ(shown(12.34, "s"), "12.3 s");
  EXPECT_EQ(shown(331.4, "B"), "331 B");
}

}  // namespace
}  // namespace semview::benchmark
