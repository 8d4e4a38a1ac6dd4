// SPDX-License-Identifier: Apache-2.0
#include "semview/service/jobs.hpp"

#include <gtest/gtest.h>

#include "semview/service/site.hpp"
#include "service/small_map.hpp"
#include "support/engine_wish.hpp"

namespace semview::service {
namespace {

class JobsTest : public ::testing::Test {
 protected:
  JobsTest() {
    config_.profile.camera = {120, 1024, -0.7, 0.7};  // tall: several chunks
    config_.threads = 1;
    config_.engine = testing::engine_wish();
    config_.cache_directory = folder_.path() / "cache";
  }
  std::shared_ptr<Site> open() { return *Site::open(map_, config_); }

  testing::TemporaryFolder folder_;
  const std::filesystem::path map_ = testing::write_small_map(folder_);
  SiteConfig config_;
};

TEST_F(JobsTest, RunsToItsEndAndTellsEachStep) {
  Jobs jobs(Limits{});
  std::vector<JobStatus> heard;
  jobs.on_change([&](const JobStatus& status) { heard.push_back(status); });
  const auto id = jobs.start_precompute(open(), {});
  ASSERT_TRUE(id.has_value());
  EXPECT_EQ(jobs.status(*id)->state, JobState::kQueued);
  EXPECT_EQ(jobs.counters().running, 1U);
  EXPECT_TRUE(jobs.run_next());
  EXPECT_FALSE(jobs.run_next());
  const auto status = jobs.status(*id);
  ASSERT_TRUE(status.has_value());
  EXPECT_EQ(status->state, JobState::kDone);
  EXPECT_EQ(status->map_id, "two_rooms");
  EXPECT_EQ(status->progress.cast, status->progress.cells);
  EXPECT_EQ(jobs.counters().running, 0U);
  EXPECT_EQ(jobs.counters().done, 1U);
  ASSERT_GE(heard.size(), 4U);
  EXPECT_EQ(heard.front().state, JobState::kQueued);
  EXPECT_EQ(heard[1].state, JobState::kRunning);
  EXPECT_EQ(heard.back().state, JobState::kDone);
}

TEST_F(JobsTest, AWaitingJobIsCancelledAtOnceAndARunningOneSoon) {
  Jobs jobs(Limits{});
  const auto first = jobs.start_precompute(open(), {});
  const auto second = jobs.start_precompute(open(), {});
  ASSERT_TRUE(first.has_value() && second.has_value());
  ASSERT_TRUE(jobs.cancel(*second).has_value());
  EXPECT_EQ(jobs.status(*second)->state, JobState::kCancelled);
  jobs.on_change([&](const JobStatus& status) {
    if (status.state == JobState::kRunning && status.progress.cast > 0) {
      ASSERT_TRUE(jobs.cancel(status.id).has_value());
    }
  });
  EXPECT_TRUE(jobs.run_next());
  EXPECT_EQ(jobs.status(*first)->state, JobState::kCancelled);
  EXPECT_LT(jobs.status(*first)->progress.cast, jobs.status(*first)->progress.cells);
  EXPECT_FALSE(jobs.run_next());
  EXPECT_EQ(jobs.counters().cancelled, 2U);
  EXPECT_EQ(jobs.counters().running, 0U);
  ASSERT_TRUE(jobs.cancel(*first).has_value()) << "twice does no harm";
  EXPECT_EQ(jobs.counters().cancelled, 2U);
  EXPECT_EQ(jobs.cancel(77).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(jobs.list().size(), 2U);
}

TEST_F(JobsTest, RefusesMoreThanItsLimitAndWhatCannotSucceed) {
  Limits limits;
  limits.max_running_jobs = 1;
  Jobs jobs(limits);
  const auto site = open();
  const auto first = jobs.start_precompute(site, {});
  ASSERT_TRUE(first.has_value());
  const Error refused = jobs.start_precompute(site, {}).error();
  EXPECT_EQ(refused.code, ErrorCode::kResourceExhausted);
  EXPECT_GT(refused.retry_after_ms, 0U);
  ASSERT_TRUE(jobs.cancel(*first).has_value());
  EXPECT_TRUE(jobs.start_precompute(site, {}).has_value());
}

TEST_F(JobsTest, WithoutACacheDirectoryTheErrorSaysHowToHaveOne) {
  config_.cache_directory.reset();
  Jobs jobs(Limits{});
  const Error refused = jobs.start_precompute(open(), {}).error();
  EXPECT_EQ(refused.code, ErrorCode::kFailedPrecondition);
  EXPECT_NE(refused.message.find("--cache"), std::string::npos) << refused.message;
  EXPECT_NE(refused.hint.find("--cache"), std::string::npos) << refused.hint;
}

TEST_F(JobsTest, ClosingCancelsWhatWaitsAndRefusesTheRest) {
  Jobs jobs(Limits{});
  const auto site = open();
  const auto waiting = jobs.start_precompute(site, {});
  ASSERT_TRUE(waiting.has_value());
  jobs.close();
  EXPECT_EQ(jobs.status(*waiting)->state, JobState::kCancelled);
  EXPECT_EQ(jobs.start_precompute(site, {}).error().code, ErrorCode::kUnavailable);
  EXPECT_FALSE(jobs.run_next());
}

TEST_F(JobsTest, AFullCacheFailsTheJobWithItsReason) {
  config_.cache_limit_bytes = 100'000;
  Jobs jobs(Limits{});
  const auto id = jobs.start_precompute(open(), {});
  ASSERT_TRUE(id.has_value());
  EXPECT_TRUE(jobs.run_next());
  EXPECT_EQ(jobs.status(*id)->state, JobState::kFailed);
  EXPECT_NE(jobs.status(*id)->error.message.find("limit"), std::string::npos);
  EXPECT_EQ(jobs.counters().failed, 1U);
}

}  // namespace
}  // namespace semview::service
