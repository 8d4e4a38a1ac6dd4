// SPDX-License-Identifier: Apache-2.0
/// From drives to the numbers of the tables.
#include "experiments/paper2017/results.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/paper2017/tables.hpp"

namespace semview::paper2017 {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TrialRecord drive(const char* method, std::uint64_t world, const std::vector<double>& errors_m) {
  TrialRecord record{"unmodified", method, Start::kLocal, world, 1001, {}};
  for (const double error_m : errors_m) {
    StopRecord stop;
    stop.stop = static_cast<int>(record.stops.size()) + 1;
    stop.best_m = stop.estimate_m = error_m;
    stop.min_m = error_m / 2.0;
    stop.odometry_m = 1.0;
    record.stops.push_back(stop);
  }
  return record;
}

Experiment two_worlds() {
  Experiment experiment;
  experiment.config.worlds = {1, 2};
  experiment.config.starts = {Start::kLocal};
  experiment.rows = {*find_row("unmodified")};
  experiment.trials = {drive("weighted", 1, {0.2, 0.4}),
                       drive("ours", 1, {0.1, 0.1}),
                       drive("weighted", 2, {1.2, 0.2}),
                       drive("ours", 2, {0.1, 0.3})};
  return experiment;
}

TEST(ResultsTest, MeansAreOfWorlds) {
  const Experiment experiment = two_worlds();
  const Results results(experiment);
  const auto means =
      results.world_means("unmodified", "weighted", Start::kLocal, &StopRecord::estimate_m);
  EXPECT_THAT(means,
              ElementsAre(::testing::DoubleNear(0.3, 1e-12), ::testing::DoubleNear(0.7, 1e-12)));
  EXPECT_THAT(results.values_at("unmodified", "ours", Start::kLocal, &StopRecord::best_m, 2),
              ElementsAre(0.1, 0.3));
  EXPECT_THAT(results.methods(Start::kLocal), ElementsAre("weighted", "ours"));
}

TEST(ResultsTest, LocalizedIsFromWhereNoLaterErrorIsLarge) {
  EXPECT_EQ(localized_from(drive("ours", 1, {0.9, 0.2, 0.3}), 0.5), 2);
  EXPECT_EQ(localized_from(drive("ours", 1, {0.2, 0.7, 0.3}), 0.5), 3);
  EXPECT_EQ(localized_from(drive("ours", 1, {0.2, 0.3, 0.7}), 0.5), std::nullopt);
}

TEST(TablesTest, ShowErrorsSharesDifferencesAndRatios) {
  const Experiment experiment = two_worlds();
  const Results results(experiment);
  const std::string fig3 = fig3_table(results, Start::kLocal);
  EXPECT_THAT(fig3,
              HasSubstr("| row | weighted: best (min) | ours: own estimate (min) | odometry |"));
  EXPECT_THAT(fig3,
              HasSubstr("| unmodified | 0.500 (0.250) | 0.150 (0.075) | 1.000 | 0.160 (0.023) | "
                        "0.120 (0.020) | 0.260 |"));
  const std::string spread = spread_table(results, Start::kLocal);
  // Two of four stops of weighted above 0.3 m, one above 1 m.
  EXPECT_THAT(spread, HasSubstr("| unmodified | weighted | 0.500 | 0.500 |"));
  EXPECT_THAT(spread, HasSubstr("| 50.0 % | 25.0 % |"));
  EXPECT_THAT(spread, HasSubstr("+0.350 [+0.200, +0.500] | 3.33 |"));
}

TEST(TablesTest, AForeignProgramsColumnNamesItsEstimate) {
  Experiment experiment = two_worlds();
  experiment.trials.push_back(drive("theirs", 1, {0.2}));
  experiment.trials.back().stops.front().min_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(fig3_table(Results(experiment), Start::kLocal),
              HasSubstr("| theirs: own estimate |"));
}

TEST(TablesTest, OneWorldHasNoIntervalOverWorlds) {
  Experiment experiment = two_worlds();
  experiment.config.worlds = {1};
  const Results results(experiment);
  EXPECT_FALSE(interval_over_worlds({0.3}));
  const std::string spread = spread_table(results, Start::kLocal);
  EXPECT_THAT(spread, HasSubstr("| unmodified | weighted | 0.300 | 0.300 | - | 50.0 % |"));
  EXPECT_THAT(spread, HasSubstr("| +0.200 | 3.00 |"));
}

}  // namespace
}  // namespace semview::paper2017
