// SPDX-License-Identifier: Apache-2.0
#include "experiments/paper2023/summary.hpp"

#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/paper2023/report.hpp"
#include "support/temporary_folder.hpp"

namespace semview::paper2023 {
namespace {

using ::testing::HasSubstr;

Run run_of(Session session, const std::string& method, double error_m) {
  Run run;
  run.session = session;
  run.method = method;
  // 5 m of error before convergence, which does not count.
  run.stops = {{0.0, 5.0, 1.0, 10.0}, {2.0, error_m, 0.1, 10.0}, {3.0, error_m + 0.2, 0.3, 10.0}};
  return run;
}

Experiment two_runs(double second_m) {
  Experiment experiment;
  experiment.runs = {run_of(Session::kStatic, "sdf", 0.2),
                     run_of(Session::kStatic, "sdf", second_m),
                     run_of(Session::kChanged, "sdf", 0.5)};
  return experiment;
}

TEST(SummaryTest, CountsImagesAfterConvergenceAlone) {
  const Summary summary = summary_of(two_runs(0.4), Session::kStatic, "sdf", true);
  EXPECT_EQ(summary.runs, 2);
  EXPECT_EQ(summary.failed, 0);
  EXPECT_NEAR(summary.position_m, (0.2 + 0.4 + 0.4 + 0.6) / 4.0, 1e-12);
  EXPECT_NEAR(summary.position_variance_m2, 0.02, 1e-12);
  EXPECT_NEAR(summary.heading_rad, 0.2, 1e-12);
  EXPECT_NEAR(summary.heading_variance_rad2, 0.01, 1e-12);
}

TEST(SummaryTest, FailedRunsAreCountedAndLeftOut) {
  const Experiment experiment = two_runs(2.0);
  EXPECT_EQ(summary_of(experiment, Session::kStatic, "sdf", true).failed, 1);
  EXPECT_NEAR(summary_of(experiment, Session::kStatic, "sdf", true).position_m, 1.2, 1e-12);
  EXPECT_NEAR(summary_of(experiment, Session::kStatic, "sdf", false).position_m, 0.3, 1e-12);
  EXPECT_TRUE(std::isnan(summary_of(experiment, Session::kStatic, "sem_gt", true).position_m));
}

TEST(SummaryTest, TablesStandBesideThePrintedOnes) {
  const std::string page = report(two_runs(2.0), {});
  EXPECT_THAT(page, HasSubstr("| sdf | 1 of 2 | 1.200 |"));
  EXPECT_THAT(page, HasSubstr("| sdf, without failed | 1 of 2 | 0.300 |"));
  EXPECT_THAT(page, HasSubstr("0.242"));
  EXPECT_THAT(page, HasSubstr("| sdf | 0.50 | 2.00 | 2.17 |"));
}

TEST(SummaryTest, CurvesAreMeansOverWhatWasDriven) {
  const auto curves = error_curves(two_runs(0.4), Session::kStatic);
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves[0].distance_m, (std::vector<double>{0.125, 2.125, 3.125}));
  EXPECT_NEAR(curves[0].position_m[1], 0.3, 1e-12);
}

TEST(ExperimentTest, WrongOptionsAreNamed) {
  ExperimentConfig config;
  config.methods = {"sdf+sem"};
  EXPECT_EQ(validate(config).error().field, "--methods");
  config.methods.clear();
  config.worlds = {101};
  EXPECT_FALSE(validate(config));
  config.worlds = {1};
  config.filter.particles = 0;
  EXPECT_EQ(validate(config).error().field, "--particles");
}

TEST(SummaryTest, TheReportsFolderIsMade) {
  const testing::TemporaryFolder folder;
  const auto directory = folder / "results" / "today";
  const auto page = write_report(two_runs(0.4), {}, directory);
  ASSERT_TRUE(page) << page.error().message;
  for (const char* file : {"report.md", "runs.csv", "error_static.svg", "error_changed.svg"}) {
    EXPECT_TRUE(std::filesystem::exists(directory / file)) << file;
  }
}

}  // namespace
}  // namespace semview::paper2023
