// SPDX-License-Identifier: Apache-2.0
/// The experiment as a whole, on one flat.
#include "experiments/paper2023/experiment.hpp"

#include <gtest/gtest.h>

#include "experiments/paper2023/report.hpp"
#include "experiments/paper2023/summary.hpp"

namespace semview::paper2023 {
namespace {

void say_nothing(std::size_t /*done*/, std::size_t /*all*/) {}

ExperimentConfig quick() {
  ExperimentConfig config;
  config.worlds = {201};
  config.static_runs = 2;
  config.changed_paths = 1;
  config.changed_runs = 1;
  return config;
}

TEST(Paper2023ExperimentTest, BothCuesTogetherAreBetterThanTheMetricOneAlone) {
  ExperimentConfig config = quick();
  config.methods = {"sdf", "sdf_sem_gt"};
  const auto experiment = run_experiment(config, say_nothing);
  ASSERT_TRUE(experiment) << experiment.error().message;
  const Summary metric = summary_of(*experiment, Session::kStatic, "sdf", true);
  const Summary both = summary_of(*experiment, Session::kStatic, "sdf_sem_gt", true);
  EXPECT_LT(both.position_m, metric.position_m);
  EXPECT_LT(both.position_m, 0.3);
  EXPECT_EQ(both.failed, 0);
}

TEST(Paper2023MethodsTest, OursIsThePapersWithThreeIdeasAndEachCanBeLeftOut) {
  const FilterConfig base;
  const FilterConfig printed = configured(*find_method("sdf_sem_rcnn"), base);
  EXPECT_EQ(printed.model.outlier, 0.0);
  EXPECT_EQ(printed.model.sigma_sdf_m, 2.0);
  EXPECT_EQ(printed.motion.alpha1, base.motion.alpha1);
  const FilterConfig ours = configured(*find_method("ours_rcnn"), base);
  EXPECT_GT(ours.model.outlier, 0.0);
  EXPECT_LT(ours.model.sigma_sdf_m, 2.0);
  EXPECT_LT(ours.motion.alpha1, base.motion.alpha1);
  EXPECT_EQ(find_method("ours_rcnn")->printed, "sdf_sem_rcnn");
  EXPECT_EQ(configured(*find_method("ours_rcnn_no_outliers"), base).model.outlier, 0.0);
  EXPECT_EQ(configured(*find_method("ours_gt_no_sigma"), base).model.sigma_sem_m, 1.5);
  EXPECT_EQ(configured(*find_method("ours_gt_no_motion"), base).motion.alpha3, base.motion.alpha3);
  EXPECT_EQ(default_methods().size(), 7U);
}

TEST(Paper2023ExperimentTest, ASeedGivesTheSameRunsForAnyNumberOfThreads) {
  ExperimentConfig config = quick();
  config.methods = {"sem_rcnn"};
  config.filter.particles = 300;
  config.world.drive.length_m = 3.0;
  config.threads = 1;
  const auto one = run_experiment(config, say_nothing);
  config.threads = 3;
  const auto three = run_experiment(config, say_nothing);
  ASSERT_TRUE(one) << one.error().message;
  ASSERT_TRUE(three);
  EXPECT_EQ(to_csv(*one), to_csv(*three));
  config.seed = 2;
  EXPECT_NE(to_csv(*one), to_csv(*run_experiment(config, say_nothing)));
}

}  // namespace
}  // namespace semview::paper2023
