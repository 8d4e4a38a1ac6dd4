// SPDX-License-Identifier: Apache-2.0
/// Depth images and what their models score over the wire.
#include <algorithm>
#include <cmath>
#include <functional>

#include "semview/core/random.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/field/depth_scores.hpp"
#include "semview/field/field_likelihood.hpp"
#include "semview/observation/voxel_reduction.hpp"
#include "semview/protocol/model_wire.hpp"
#include "semview/protocol/voxel_wire.hpp"
#include "semview/service/field_likelihoods.hpp"
#include "server/server_fixture.hpp"

namespace semview::test {
namespace {

constexpr Pose2 kPlace{3.0, 1.5, 0.0};

/// A level camera 0.72 m up, a metre before the wall x = 3.9 m, which fills its image, but for a
/// strip of a table's front that is nearer.
DepthObservation wall_and_table() {
  DepthObservation seen;
  seen.classes = ClassTable({"table", "wall"});
  seen.camera = {32, 24, 40.0, 40.0, 16.0, 12.0};
  seen.depth_m = Image<float>(24, 32, 0.9F);
  seen.labels = LabelImage(24, 32, 2);
  for (int column = 0; column < 6; ++column) {
    seen.depth_m.at(12, column) = 0.5F;
    seen.labels.at(12, column) = 1;
  }
  Eigen::Matrix3d level;  // x right, y down, z forward
  level << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  seen.base_from_camera.translate(Eigen::Vector3d(0.0, 0.0, 0.72));
  seen.base_from_camera.rotate(level);
  return seen;
}

class DepthTest : public ServerFixture {
 protected:
  void SetUp() override {
    ServerFixture::SetUp();
    client_ = std::make_unique<RawClient>(server_->endpoint());
  }

  /// Without labels of a panorama.
  v1::SetObservationRequest depth_request() const {
    const DepthObservation seen = wall_and_table();
    v1::SetObservationRequest request;
    request.set_map_id("room");
    for (const std::string& name : seen.classes.names()) request.add_class_names(name);
    protocol::to_wire(seen, request.mutable_depth());
    return request;
  }

  v1::SetObservationRequest voxel_request() const {
    v1::SetObservationRequest request = depth_request();
    request.clear_depth();
    protocol::to_wire(*observation::reduce(wall_and_table()), request.mutable_voxels());
    return request;
  }

  std::string sent(const v1::SetObservationRequest& request) {
    return client_->get<v1::SetObservationReply>("SetObservation", request).observation_id();
  }

  ScoreBatch scored(const std::string& id, const ScoreRequest& asked, const DepthScoring& scoring) {
    v1::ScoreRequest request;
    protocol::to_wire(asked, &request);
    request.set_map_id("room");
    request.set_observation_id(id);
    request.set_model(protocol::to_wire(scoring.model));
    protocol::to_wire(scoring, request.mutable_scoring());
    return *protocol::from_wire(client_->get<v1::ScoreReply>("Score", request), asked);
  }

  ScoreBatch in_process(const ScoreRequest& asked, const DepthScoring& scoring) {
    ThreadPool pool(1);
    const auto likelihood = *site_->likelihoods().of(scoring);
    const auto prepared = *likelihood->prepare(*observation::reduce(wall_and_table()), pool);
    return *field::score_depth(*likelihood, *prepared, asked, pool);
  }

  v1::HeatmapRequest heat_request(const std::string& id, ScoreModel model) const {
    v1::HeatmapRequest request;
    request.set_map_id("room");
    request.set_observation_id(id);
    request.set_model(protocol::to_wire(model));
    return request;
  }

  std::unique_ptr<RawClient> client_;
};

TEST_F(DepthTest, ScoresAreThoseOfTheCallInProcessForEachModel) {
  const std::string id = sent(voxel_request());
  for (const ScoreModel model : {ScoreModel::kSdf, ScoreModel::kSem, ScoreModel::kSdfSem}) {
    const DepthScoring scoring{.model = model};
    const ScoreRequest as_given{many_poses(700)};
    EXPECT_EQ(scored(id, as_given, scoring).sums, in_process(as_given, scoring).sums);
  }
  const ScoreRequest compass{many_poses(9), HeadingMode::kCompass, true};
  const DepthScoring scoring{.sigma_sem_m = 0.4, .by_movable = true};
  const ScoreBatch remote = scored(id, compass, scoring);
  const ScoreBatch local = in_process(compass, scoring);
  EXPECT_EQ(remote.sums, local.sums);
  EXPECT_EQ(remote.best_heading, local.best_heading);
  EXPECT_EQ(remote.curve, local.curve);
  EXPECT_NE(remote.sums, in_process(compass, {}).sums);
}

TEST_F(DepthTest, ADepthImageScoresAsTheVoxelsThatItComesTo) {
  const ScoreRequest asked{many_poses(100)};
  EXPECT_EQ(scored(sent(depth_request()), asked, {}).sums,
            scored(sent(voxel_request()), asked, {}).sums);
}

/// A corner of a room of 4 × 4 × 2.5 m, millimetres of noise on it, each surface of its own class.
DepthObservation corner_in_full_resolution() {
  DepthObservation seen;
  seen.classes = ClassTable({"floor", "ceiling", "wall", "cupboard"});
  seen.depth_m = Image<float>(480, 640);
  seen.labels = LabelImage(480, 640);
  seen.base_from_camera = wall_and_table().base_from_camera;
  Rng rng(5, "noise");
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitZ()) * seen.base_from_camera.linear();
  for (int row = 0; row < 480; ++row) {
    for (int column = 0; column < 640; ++column) {
      const Eigen::Vector3d ray = turn * seen.camera.direction(row, column);
      const Eigen::Array3d far =
          (ray.array() > 0.0)
              .select(Eigen::Array3d(2.0, 2.0, 1.78), Eigen::Array3d(-2.0, -2.0, -0.72));
      int axis = 0;
      const double depth_m = (far / ray.array()).minCoeff(&axis);
      seen.depth_m.at(row, column) = static_cast<float>(depth_m + rng.normal(0.0, 0.003));
      seen.labels.at(row, column) =
          static_cast<ClassId>(axis == 2 ? (ray.z() > 0.0 ? 2 : 1) : 3 + axis);
    }
  }
  return seen;
}

TEST_F(DepthTest, AFullImageComesToAtMost100KilobytesAndScoresTheSame) {
  const DepthObservation seen = corner_in_full_resolution();
  v1::SetObservationRequest image = depth_request();
  image.clear_class_names();
  image.clear_depth();
  for (const std::string& name : seen.classes.names()) image.add_class_names(name);
  protocol::to_wire(seen, image.mutable_depth());
  v1::SetObservationRequest voxels = image;
  voxels.clear_depth();
  // What millimetres have left of the depth is what both are made of.
  const auto stored = protocol::from_wire(image.depth(), seen.classes, 0.0);
  protocol::to_wire(*observation::reduce(*stored), voxels.mutable_voxels());
  EXPECT_GT(image.ByteSizeLong(), 900'000U);
  EXPECT_LT(voxels.ByteSizeLong(), 100'000U);
  const ScoreRequest asked{many_poses(3)};
  EXPECT_EQ(scored(sent(image), asked, {}).sums, scored(sent(voxels), asked, {}).sums);
}

TEST_F(DepthTest, ItsOwnPlaceIsLikelierThanOthers) {
  const ScoreRequest asked{{kPlace, {2.4, 1.5, 0.0}, {3.0, 1.5, 2.0}}};
  const auto sums = scored(sent(voxel_request()), asked, {}).sums;
  EXPECT_GT(sums[0], sums[1]);
  EXPECT_GT(sums[0], sums[2]);
}

TEST_F(DepthTest, LabelsAndDepthMayComeTogether) {
  v1::SetObservationRequest both = observation_request();
  protocol::to_wire(VoxelList{{}, 0.05, {{10, 0, 14, 1, 5}}, 0.0}, both.mutable_voxels());
  const auto reply = client_->get<v1::SetObservationReply>("SetObservation", both);
  EXPECT_GT(reply.observed_pixels(), 0);
  EXPECT_EQ(reply.observed_voxels(), 1U);
  const ScoreRequest asked{many_poses(5)};
  EXPECT_EQ(scored(reply.observation_id(), asked, {}).observed_pixels, 1);
  v1::ScoreRequest views = score_request(reply.observation_id(), 5);
  EXPECT_EQ(client_->get<v1::ScoreReply>("Score", views).observed_pixels(),
            reply.observed_pixels());
}

TEST_F(DepthTest, AHeatMapHoldsTheBestOfItsHeadings) {
  const std::string id = sent(voxel_request());
  v1::HeatmapRequest request = heat_request(id, ScoreModel::kSdfSem);
  request.set_headings(20);
  const auto heat = client_->get<v1::HeatmapReply>("Heatmap", request);
  ScoreRequest asked;
  for (int k = 0; k < 120; k += 6)
    asked.poses.push_back({3.05, 1.55, PoseGrid::heading_yaw_rad(k)});
  const ScoreBatch batch = in_process(asked, {});
  const auto best = std::ranges::max_element(batch.sums);
  const auto place = static_cast<int>((15 - heat.origin_iy()) * static_cast<int>(heat.columns()) +
                                      (30 - heat.origin_ix()));
  EXPECT_EQ(heat.similarity(place), static_cast<float>(batch.similarity(*best)));
  EXPECT_EQ(static_cast<std::uint8_t>(heat.best_headings()[static_cast<std::size_t>(place)]),
            6 * (best - batch.sums.begin()));
}

TEST_F(DepthTest, ProbabilitiesAddUpToOne) {
  v1::HeatmapRequest request = heat_request(sent(voxel_request()), ScoreModel::kSem);
  request.mutable_posterior();
  request.mutable_region()->set_x_min_m(2.6);
  request.mutable_region()->set_y_min_m(1.0);
  request.mutable_region()->set_x_max_m(3.4);
  request.mutable_region()->set_y_max_m(2.0);
  const auto heat = client_->get<v1::HeatmapReply>("Heatmap", request);
  double sum = 0.0;
  for (const float probability : heat.probability()) {
    if (!std::isnan(probability)) sum += static_cast<double>(probability);
  }
  EXPECT_NEAR(sum, 1.0, 1e-5);
}

TEST_F(DepthTest, WhatIsMissingOrWrongIsNamed) {
  const auto blamed = [this](std::string_view method, const auto& body) {
    return client_->error_of(method, body).field();
  };
  v1::ScoreRequest views = score_request(sent(voxel_request()), 3);
  EXPECT_EQ(blamed("Score", views), "model");  // no labels were sent
  v1::ScoreRequest depth = score_request(set_observation(*client_), 3);
  depth.set_model(v1::MODEL_SEM);
  EXPECT_EQ(blamed("Score", depth), "model");  // no depth was sent
  depth.set_model(static_cast<v1::Model>(50));
  EXPECT_EQ(blamed("Score", depth), "model");
  depth = score_request(sent(voxel_request()), 1);
  depth.set_model(v1::MODEL_SDF);
  depth.mutable_scoring()->set_sigma_sdf_m(-1.0);
  EXPECT_EQ(blamed("Score", depth), "scoring.sigma_sdf_m");
  depth.clear_scoring();
  for (auto* const list : {depth.mutable_affines()->mutable_a(),
                           depth.mutable_affines()->mutable_b(),
                           depth.mutable_affines()->mutable_k()}) {
    list->Add(1);
  }
  EXPECT_EQ(blamed("Score", depth), "affines");
  v1::HeatmapRequest heat = heat_request(sent(voxel_request()), ScoreModel::kSdf);
  heat.mutable_posterior()->set_power(2.0);
  EXPECT_EQ(blamed("Heatmap", heat), "posterior.power");
  v1::SetObservationRequest both = depth_request();
  *both.mutable_voxels() = voxel_request().voxels();
  EXPECT_EQ(blamed("SetObservation", both), "depth");
  v1::SetObservationRequest far = depth_request();
  far.mutable_depth()->set_max_depth_m(0.2);
  EXPECT_EQ(blamed("SetObservation", far), "depth");  // nothing is as near as that
  expect_alive();
}

}  // namespace
}  // namespace semview::test
