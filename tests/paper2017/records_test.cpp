// SPDX-License-Identifier: Apache-2.0
#include "experiments/paper2017/records.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semview::paper2017 {
namespace {

using ::testing::HasSubstr;

TrialRecord drive(const char* method, std::uint64_t seed) {
  TrialRecord record{"scale_1.5", method, Start::kGlobal, 3, seed, {}};
  for (int stop = 1; stop <= 2; ++stop) {
    StopRecord one;
    one.stop = stop;
    one.best_m = 0.125 * stop;
    one.estimate_m = 0.25;
    one.min_m = 0.0625;
    one.odometry_m = 1.5;
    one.particles = 500;
    one.affine = {0.67, 1.5, 0.0};
    record.stops.push_back(one);
  }
  return record;
}

TEST(RecordsTest, CsvIsReadBackAsItWas) {
  const std::string text = "# settings\n" + csv_header() + to_csv(drive("ours", 1001)) +
                           to_csv(drive("ours", 1002)) + to_csv(drive("weighted", 1002));
  const auto read = parse_trials(text, "runs.csv");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 3U);
  EXPECT_EQ(read->at(1).filter_seed, 1002U);
  EXPECT_EQ(read->at(2).method, "weighted");
  EXPECT_EQ(read->at(2).start, Start::kGlobal);
  ASSERT_EQ(read->at(2).stops.size(), 2U);
  EXPECT_DOUBLE_EQ(read->at(2).stops[1].best_m, 0.25);
  EXPECT_DOUBLE_EQ(read->at(2).stops[1].affine.b, 1.5);
  EXPECT_EQ(to_csv(read->at(0)), to_csv(drive("ours", 1001)));
}

TEST(RecordsTest, ADamagedLineIsNamed) {
  const std::string good = csv_header() + to_csv(drive("ours", 1));
  for (const char* bad : {"a,b,c\n", "scale_1.5,ours,sideways,3,3,1,1,0,0,0,0,0,0,0,5,0,1,1,0\n"}) {
    const auto read = parse_trials(good + bad, "runs.csv");
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().message, HasSubstr("runs.csv:4:"));
  }
}

TEST(RecordsTest, TimesStandApart) {
  TrialRecord one = drive("ours", 1);
  TrialRecord slower = one;
  slower.stops[0].update_s = 3.0;
  EXPECT_EQ(to_csv(one), to_csv(slower));
  EXPECT_NE(times_csv(one), times_csv(slower));
}

}  // namespace
}  // namespace semview::paper2017
