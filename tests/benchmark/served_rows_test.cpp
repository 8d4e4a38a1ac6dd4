// SPDX-License-Identifier: Apache-2.0
// The rows over TCP, with a "server" that is none: what they compare, and that a lie is noticed.
#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/benchmark/suite.hpp"
#include "semview/similarity/similarity_score_source.hpp"

namespace semview::benchmark {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Passes a view source on, with the views of other cells if it is to lie.
class Views final : public ViewSource {
 public:
  Views(ViewSource& source, bool lies) : source_(source), lies_(lies) {}
  const ViewProfile& profile() const override { return source_.profile(); }
  Result<ViewBatch> views(std::span<const CellIndex> cells) override {
    SEMVIEW_TRY(ViewBatch batch, source_.views(cells));
    if (lies_) std::ranges::reverse(batch.views);
    return batch;
  }

 private:
  ViewSource& source_;
  bool lies_;
};

class Scores final : public ScoreSource {
 public:
  Scores(std::unique_ptr<ScoreSource> source, bool lies)
      : source_(std::move(source)), lies_(lies) {}
  const ViewProfile& profile() const override { return source_->profile(); }
  Status set_observation(const Observation& observation) override {
    return source_->set_observation(observation);
  }
  Result<ScoreBatch> score(const ScoreRequest& request) override {
    SEMVIEW_TRY(ScoreBatch batch, source_->score(request));
    if (lies_) ++batch.sums.back();
    return batch;
  }

 private:
  std::unique_ptr<ScoreSource> source_;
  bool lies_;
};

class NotServed final : public ServedSite {
 public:
  NotServed(std::shared_ptr<service::Site> site, bool lies)
      : site_(std::move(site)), views_(site_->views(), lies), lies_(lies) {}
  ViewSource& views() override { return views_; }
  std::uint64_t received_bytes() const override { return 0; }
  Result<std::unique_ptr<ScoreSource>> scores(
      const similarity::WeightMatrix& weights) const override {
    return std::make_unique<Scores>(
        std::make_unique<similarity::SimilarityScoreSource>(
            site_->views(), site_->map().classes, weights, site_->pool()),
        lies_);
  }

 private:
  std::shared_ptr<service::Site> site_;
  Views views_;
  bool lies_;
};

std::vector<Row> rows_of(const std::vector<std::string>& ids, const Serve& serve) {
  SuiteConfig config;
  config.quick = true;
  config.only = ids;
  config.threads = {1};
  config.serve = serve;
  auto rows = run_suite(config, [](const Progress&) {});
  EXPECT_TRUE(rows) << rows.error().message;
  return rows ? *std::move(rows) : std::vector<Row>();
}

Serve serving(bool lies) {
  return [lies](std::shared_ptr<service::Site> site,
                std::size_t) -> Result<std::unique_ptr<ServedSite>> {
    return std::make_unique<NotServed>(std::move(site), lies);
  };
}

TEST(ServedRowsTest, WhatIsServedIsComparedWithTheCallInProcessAndTimedByTheWall) {
  const auto rows =
      rows_of({"served_cold", "served_warm", "served_views", "served_compass"}, serving(false));
  ASSERT_EQ(rows.size(), 4U);
  for (const Row& row : rows) {
    ASSERT_TRUE(row.found) << row.id << ": " << row.note;
    EXPECT_EQ(row.found->clock, "wall") << row.id;
    EXPECT_THAT(row.found->agreement, HasSubstr("equal")) << row.id;
  }
}

TEST(ServedRowsTest, ServedResultsThatDifferAreSaidToAndNotTimed) {
  const auto rows = rows_of({"served_cold", "served_views", "served_compass"}, serving(true));
  ASSERT_EQ(rows.size(), 3U);
  for (const Row& row : rows) {
    EXPECT_TRUE(row.disagrees) << row.id;
    EXPECT_FALSE(row.found) << row.id;
    EXPECT_THAT(row.note, StartsWith("results differ: ")) << row.id;
  }
}

TEST(ServedRowsTest, WithoutAServerTheRowsSaySo) {
  for (const Row& row : rows_of({"served_warm", "served_compass"}, {})) {
    EXPECT_FALSE(row.disagrees);
    EXPECT_EQ(row.note, "not installed: a server to measure");
  }
}

}  // namespace
}  // namespace semview::benchmark
