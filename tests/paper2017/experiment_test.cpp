// SPDX-License-Identifier: Apache-2.0
/// The experiment as a whole, on few worlds and runs.
#include "experiments/paper2017/experiment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/paper2017/results.hpp"
#include "semview/io/text_file.hpp"
#include "support/temporary_folder.hpp"

namespace semview::paper2017 {
namespace {

using semview::testing::TemporaryFolder;
using ::testing::HasSubstr;

void say_nothing(const ExperimentProgress& /*progress*/) {}

std::string runs_csv(const ExperimentConfig& config) {
  return *io::read_text_file(config.out / "runs.csv", std::size_t{1} << 28U);
}

/// Two rows on a world, quick methods.
ExperimentConfig few(const std::filesystem::path& out) {
  ExperimentConfig config;
  config.rows = {"unmodified", "classes_basic"};
  config.worlds = {1};
  config.runs = 1;
  config.methods = {"weighted"};
  config.starts = {Start::kLocal};
  config.threads = 1;
  config.out = out;
  return config;
}

TEST(ExperimentTest, ThreadsAndResumingChangeNoByte) {
  const TemporaryFolder folder;
  ExperimentConfig one = few(folder / "one");
  ASSERT_TRUE(run_experiment(one, say_nothing));
  ExperimentConfig two = few(folder / "two");
  two.threads = 2;
  ASSERT_TRUE(run_experiment(two, say_nothing));
  EXPECT_EQ(runs_csv(one), runs_csv(two));

  ASSERT_TRUE(std::filesystem::remove(two.out / "units/classes_basic.world_1.csv"));
  two.resume = true;
  std::size_t units = 0;
  ASSERT_TRUE(run_experiment(two, [&](const ExperimentProgress& progress) {
    ++units;
    EXPECT_EQ(progress.done, 2U);
  }));
  EXPECT_EQ(units, 1U);
  EXPECT_EQ(runs_csv(one), runs_csv(two));
}

TEST(ExperimentTest, ResultsOfOtherSettingsAreNotMixedIn) {
  const TemporaryFolder folder;
  ExperimentConfig config = few(folder / "out");
  config.rows = {"unmodified"};
  ASSERT_TRUE(run_experiment(config, say_nothing));
  const auto again = run_experiment(config, say_nothing);
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().message, HasSubstr("holds results already"));
  config.resume = true;
  config.seed = 2;
  const auto other = run_experiment(config, say_nothing);
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message, HasSubstr("was made with other settings"));
}

TEST(ExperimentTest, AUnitThatWasCutIsToldWithWhatToDo) {
  const TemporaryFolder folder;
  ExperimentConfig config = few(folder / "out");
  config.rows = {"unmodified"};
  ASSERT_TRUE(run_experiment(config, say_nothing));
  config.resume = true;
  const std::filesystem::path unit = config.out / "units/unmodified.world_1.csv";
  const std::string whole = *io::read_text_file(unit, std::size_t{1} << 28U);
  const std::size_t line_end = whole.find('\n', whole.size() / 2) + 1;
  for (const std::size_t length : {line_end, line_end - 5}) {
    ASSERT_TRUE(io::write_text_file(unit, whole.substr(0, length)));
    const auto cut = run_experiment(config, say_nothing);
    ASSERT_FALSE(cut);
    EXPECT_THAT(cut.error().message, HasSubstr("was cut"));
    EXPECT_THAT(cut.error().hint, HasSubstr("delete " + unit.string()));
  }
  std::string damaged = whole;
  damaged.erase(line_end - 1, 1);
  ASSERT_TRUE(io::write_text_file(unit, damaged));
  const auto refused = run_experiment(config, say_nothing);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().hint, HasSubstr("delete " + unit.string()));
}

TEST(ExperimentTest, BadOptionsAreRefusedByName) {
  const auto field = [](const auto& change) {
    ExperimentConfig config = few("unused");
    change(config);
    const Status status = validate(config);
    return status ? std::string("accepted") : status.error().field;
  };
  EXPECT_EQ(field([](ExperimentConfig& config) { config.runs = 0; }), "--runs");
  EXPECT_EQ(field([](ExperimentConfig& config) { config.rows = {"scale_9"}; }), "--rows");
  EXPECT_EQ(field([](ExperimentConfig& config) { config.methods = {"magic"}; }), "--methods");
  EXPECT_EQ(field([](ExperimentConfig& config) { config.worlds = {1, 201}; }), "--worlds");
  EXPECT_EQ(field([](ExperimentConfig& config) { config.starts = {}; }), "--starts");
}

/// `semview evaluate paper2017 --quick`: not its values, its orderings.
TEST(ExperimentTest, QuickRunHasThePapersOrderings) {
  const TemporaryFolder folder;
  ExperimentConfig config;
  config.rows = {"unmodified", "scale_1.2", "scale_1.4", "shear_0.5"};
  config.worlds = {1, 2, 3};
  config.runs = 3;
  config.starts = {Start::kLocal};
  config.out = folder / "quick";
  const auto experiment = run_experiment(config, say_nothing);
  ASSERT_TRUE(experiment) << experiment.error().message;
  const Results results(*experiment);
  const auto error_m = [&](const std::string& row, const char* method) {
    return evaluation::mean(
        results.world_means(row, method, Start::kLocal, &StopRecord::estimate_m));
  };
  for (const std::string& row : config.rows) {
    EXPECT_LE(error_m(row, "ours"), error_m(row, "weighted")) << row;
    // Undistorted, the two are as good as each other (experiments/paper2017/README.md).
    if (row == "unmodified") continue;
    EXPECT_LE(error_m(row, "weighted"), error_m(row, "identity")) << row;
  }
}

}  // namespace
}  // namespace semview::paper2017
