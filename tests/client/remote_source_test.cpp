// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <span>

#include "client/client_fixture.hpp"
#include "client/lib/remote_score_source.hpp"
#include "client/lib/remote_view_source.hpp"
#include "semview/core/random.hpp"
#include "semview/field/field_score_source.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/observation/cell_posterior.hpp"
#include "semview/service/field_likelihoods.hpp"
#include "semview/similarity/heat_map.hpp"
#include "semview/similarity/similarity_score_source.hpp"
#include "support/eventually.hpp"

namespace semview::test {
namespace {

using client::RemoteScoreSource;
using client::RemoteViewSource;
using semview::testing::eventually;

class RemoteSourceTest : public ClientFixture {
 protected:
  similarity::WeightMatrix weights() const {
    return similarity::WeightMatrix::identity(site_->map().classes);
  }
  Observation observation() const { return observation_at(*site_, {2.0, 1.0, 0.5}); }

  ScoreBatch in_process(const ScoreRequest& request) const {
    similarity::SimilarityScoreSource source(
        site_->views(), site_->map().classes, weights(), site_->pool());
    EXPECT_TRUE(source.set_observation(observation()));
    auto batch = source.score(request);
    EXPECT_TRUE(batch);
    return *std::move(batch);
  }

  static bool same_bits(std::span<const float> a, std::span<const float> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
  }

  static void expect_equal(const ScoreBatch& a, const ScoreBatch& b) {
    EXPECT_EQ(a.weight_scale, b.weight_scale);
    EXPECT_EQ(a.observed_pixels, b.observed_pixels);
    EXPECT_EQ(a.sums, b.sums);
    EXPECT_EQ(a.best_heading, b.best_heading);
    EXPECT_EQ(a.curve, b.curve);
  }
};

TEST_F(RemoteSourceTest, ViewsAreThoseOfTheSite) {
  const auto source = RemoteViewSource::open(config(), "room");
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_EQ((*source)->profile(), site_->profile());
  std::vector<CellIndex> cells = site_->cells().free_cells();
  cells.push_back({-100, -100});
  cells.push_back(cells.front());
  const auto remote = (*source)->views(cells);
  const auto local = site_->views().views(cells);
  ASSERT_TRUE(remote) << remote.error().message;
  ASSERT_TRUE(local);
  ASSERT_EQ(remote->views.size(), cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    ASSERT_EQ(remote->views[i] == nullptr, local->views[i] == nullptr);
    if (remote->views[i] == nullptr) continue;
    EXPECT_EQ(*remote->views[i], *local->views[i]);
  }
}

TEST_F(RemoteSourceTest, ScoresAreThoseOfTheSourceInProcess) {
  const auto source = RemoteScoreSource::open(config(), "room", weights());
  ASSERT_TRUE(source) << source.error().message;
  ASSERT_TRUE((*source)->set_observation(observation()));
  for (const bool curve : {false, true}) {
    const ScoreRequest request{many_poses(2000), HeadingMode::kCompass, curve};
    const auto remote = (*source)->score(request);
    ASSERT_TRUE(remote) << remote.error().message;
    expect_equal(*remote, in_process(request));
  }
  const ScoreRequest request{many_poses(2000), HeadingMode::kAsGiven, false};
  const auto remote = (*source)->score(request);
  ASSERT_TRUE(remote);
  expect_equal(*remote, in_process(request));
}

TEST_F(RemoteSourceTest, ScoresOfDistortedMapsAreThoseOfTheSourceInProcess) {
  const auto source = RemoteScoreSource::open(config(), "room", weights());
  ASSERT_TRUE(source) << source.error().message;
  ASSERT_TRUE((*source)->set_observation(observation()));
  Rng rng(3, "affines");
  for (const HeadingMode mode : {HeadingMode::kAsGiven, HeadingMode::kCompass}) {
    ScoreRequest request{many_poses(300), mode, mode == HeadingMode::kCompass};
    for (std::size_t i = 0; i < request.poses.size(); ++i) {
      const bool exact = i % 5 == 0;
      request.affines.push_back(
          exact ? MapAffine{}
                : MapAffine{rng.uniform(0.8, 1.2), rng.uniform(0.8, 1.2), rng.uniform(-0.3, 0.3)});
    }
    const auto remote = (*source)->score(request);
    ASSERT_TRUE(remote) << remote.error().message;
    expect_equal(*remote, in_process(request));
  }
}

TEST_F(RemoteSourceTest, ScoresOfDepthAreThoseOfTheSourceInProcess) {
  Observation seen;
  seen.voxels = VoxelList{ClassTable({"wall", "lamp"}), 0.1, {}, 0.0};
  for (std::int16_t y = -9; y < 9; ++y) {
    seen.voxels->voxels.push_back({12, y, 8, 1, 5});
  }
  seen.voxels->voxels.push_back({7, 0, 8, 2, 3});
  const DepthScoring scoring{.z_sdf = 0.3, .sigma_sem_m = 0.4};
  field::FieldScoreSource local(*site_->likelihoods().of(scoring), site_->profile(), site_->pool());
  ASSERT_TRUE(local.set_observation(seen));
  const auto remote = RemoteScoreSource::open(config(), "room", scoring);
  ASSERT_TRUE(remote) << remote.error().message;
  ASSERT_TRUE((*remote)->set_observation(seen));
  for (const bool compass : {false, true}) {
    const ScoreRequest request{
        many_poses(50), compass ? HeadingMode::kCompass : HeadingMode::kAsGiven, compass};
    const auto answer = (*remote)->score(request);
    ASSERT_TRUE(answer) << answer.error().message;
    expect_equal(*answer, *local.score(request));
  }
  // A server that has forgotten gets the voxels again.
  stop();
  start();
  const auto again = (*remote)->score({many_poses(9)});
  ASSERT_TRUE(again) << again.error().message;
  expect_equal(*again, *local.score({many_poses(9)}));

  const Status without = (*remote)->set_observation(observation());
  ASSERT_FALSE(without);
  EXPECT_EQ(without.error().field, "voxels");
}

TEST_F(RemoteSourceTest, ADistortionOutOfRangeIsRefusedHereAndThere) {
  const auto source = RemoteScoreSource::open(config(), "room", weights());
  ASSERT_TRUE((*source)->set_observation(observation()));
  ScoreRequest request{many_poses(1)};
  request.affines = {{.a = 7.0}};
  EXPECT_EQ((*source)->score(request).error().field, "affines");
}

TEST_F(RemoteSourceTest, HeatMapsAndPosteriorsAreThoseInProcess) {
  const auto source = RemoteScoreSource::open(config(), "room", weights());
  ASSERT_TRUE(source) << source.error().message;
  ASSERT_TRUE((*source)->set_observation(observation()));
  const std::vector<CellIndex> cells = site_->cells().free_cells();
  const auto prepared = similarity::PreparedObservation::build(
      observation(), weights(), site_->map().classes, site_->profile().camera);
  ASSERT_TRUE(prepared);
  for (const auto& weighting :
       {observation::SimilarityWeightingConfig{},
        observation::SimilarityWeightingConfig{.power = 3.5},
        observation::SimilarityWeightingConfig{
            .transform = observation::WeightTransform::kExponential, .kappa = 7.0}}) {
    const auto remote = (*source)->heat_map({.headings = 24, .posterior = weighting});
    ASSERT_TRUE(remote) << remote.error().message;
    const auto local = similarity::heat_map(
        *prepared, site_->views(), cells, 24, site_->pool(), {}, [&](const auto& similarities) {
          return observation::cell_log_weight(weighting, similarities);
        });
    ASSERT_TRUE(local);
    const auto probabilities = observation::cell_probabilities(local->log_weight.pixels());
    ASSERT_TRUE(probabilities);
    EXPECT_EQ(remote->heat.origin, local->origin);
    EXPECT_EQ(remote->heat.best_heading, local->best_heading);
    EXPECT_TRUE(same_bits(remote->heat.similarity.pixels(), local->similarity.pixels()));
    EXPECT_TRUE(same_bits(remote->probability.pixels(), *probabilities));
  }
}

TEST_F(RemoteSourceTest, APosteriorsWeightsAreCheckedByTheServer) {
  const auto source = RemoteScoreSource::open(config(), "room", weights());
  ASSERT_TRUE((*source)->set_observation(observation()));
  const auto refused =
      (*source)->heat_map({.posterior = observation::SimilarityWeightingConfig{.power = -1.0}});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(refused.error().field, "posterior.power");
}

TEST_F(RemoteSourceTest, ScoringBeforeAnObservationIsAFailedPrecondition) {
  const auto source = RemoteScoreSource::open(config(), "room", weights());
  ASSERT_TRUE(source);
  EXPECT_EQ((*source)->score({many_poses(1)}).error().code, ErrorCode::kFailedPrecondition);
}

TEST_F(RemoteSourceTest, AnObservationOfAnotherShapeIsRefused) {
  const auto source = RemoteScoreSource::open(config(), "room", weights());
  Observation wrong = observation();
  wrong.labels = LabelImage(10, 10, 1);
  EXPECT_EQ((*source)->set_observation(wrong).error().code, ErrorCode::kInvalidArgument);
}

TEST_F(RemoteSourceTest, AfterARestartTheObservationIsSentAgain) {
  const auto source = RemoteScoreSource::open(config(), "room", weights());
  ASSERT_TRUE((*source)->set_observation(observation()));
  const ScoreRequest request{many_poses(50), HeadingMode::kCompass, false};
  stop();
  start();
  const auto remote = (*source)->score(request);
  ASSERT_TRUE(remote) << remote.error().message;
  expect_equal(*remote, in_process(request));
}

TEST_F(RemoteSourceTest, AnObservationDroppedForOthersIsSentAgain) {
  const auto source = RemoteScoreSource::open(config(), "room", weights());
  ASSERT_TRUE((*source)->set_observation(observation()));
  const ScoreRequest request{many_poses(5), HeadingMode::kCompass, false};
  const ScoreBatch expected = in_process(request);
  // Enough others to push it out.
  for (std::size_t sent = 0; sent < service::Limits{}.max_observations; ++sent) {
    if (sent % service::Limits{}.max_observations_per_client == 0) {
      const auto other = RemoteScoreSource::open(config(), "room", weights());
      for (std::size_t i = 0; i < service::Limits{}.max_observations_per_client; ++i) {
        ASSERT_TRUE((*other)->set_observation(observation()));
      }
    }
  }
  const auto remote = (*source)->score(request);
  ASSERT_TRUE(remote) << remote.error().message;
  expect_equal(*remote, expected);
}

TEST_F(RemoteSourceTest, WithoutAServerCallsFailAndLaterOnesRecover) {
  const auto source = RemoteScoreSource::open(config(200), "room", weights());
  ASSERT_TRUE((*source)->set_observation(observation()));
  const ScoreRequest request{many_poses(50), HeadingMode::kCompass, false};
  stop();
  EXPECT_EQ((*source)->score(request).error().code, ErrorCode::kUnavailable);
  EXPECT_EQ((*source)->set_observation(observation()).error().code, ErrorCode::kUnavailable);
  EXPECT_EQ((*source)->score(request).error().code, ErrorCode::kUnavailable);
  start();
  Result<ScoreBatch> remote = fail(ErrorCode::kUnknown, "");
  for (int i = 0; i < 100 && !remote; ++i) remote = (*source)->score(request);
  ASSERT_TRUE(remote) << remote.error().message;
  expect_equal(*remote, in_process(request));
}

TEST_F(RemoteSourceTest, AServerThatIsLostIsWaitedForOnceAndThenOnlyAskedBriefly) {
  using Seconds = std::chrono::duration<double>;
  constexpr double kTimeout_s = 3.0;
  const auto source =
      RemoteScoreSource::open(config(1000 * static_cast<int>(kTimeout_s)), "room", weights());
  ASSERT_TRUE((*source)->set_observation(observation()));
  const ScoreRequest request{many_poses(50), HeadingMode::kCompass, false};
  stop();
  EXPECT_EQ((*source)->set_observation(observation()).error().code, ErrorCode::kUnavailable);
  const auto start_of_loss = std::chrono::steady_clock::now();
  for (int frame = 0; frame < 8; ++frame) {
    EXPECT_EQ((*source)->set_observation(observation()).error().code, ErrorCode::kUnavailable);
  }
  EXPECT_LT(Seconds(std::chrono::steady_clock::now() - start_of_loss).count(), kTimeout_s)
      << "eight frames together wait less than one did before";
  start();
  ASSERT_TRUE(eventually([&] { return (*source)->set_observation(observation()).has_value(); }));
  const auto remote = (*source)->score(request);
  ASSERT_TRUE(remote) << remote.error().message;
  expect_equal(*remote, in_process(request));
}

TEST_F(RemoteSourceTest, AServerWithAnotherMapUnderTheIdIsNoticed) {
  const auto scores = RemoteScoreSource::open(config(), "room", weights());
  const auto views = RemoteViewSource::open(config(), "room");
  ASSERT_TRUE((*scores)->set_observation(observation()));
  stop();
  site_ = open_site(write_room(folder_.path(), "changed", 2.5), "room");
  start();
  EXPECT_EQ((*scores)->score({many_poses(5)}).error().field, "fingerprint");
  EXPECT_EQ((*scores)->set_observation(observation()).error().field, "fingerprint");
  EXPECT_EQ((*views)->views(std::vector<CellIndex>{{5, 5}}).error().code,
            ErrorCode::kFailedPrecondition);
}

}  // namespace
}  // namespace semview::test
