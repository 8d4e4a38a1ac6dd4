// SPDX-License-Identifier: Apache-2.0
/// What a peer may send wrongly, and that it gets a typed error which names the field.
#include <limits>
#include <type_traits>

#include <google/protobuf/message.h>

#include "semview/core/random.hpp"
#include "server/server_fixture.hpp"

namespace semview::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class MalformedTest : public ServerFixture {
 protected:
  void SetUp() override {
    ServerFixture::SetUp();
    client_ = std::make_unique<RawClient>(server_->endpoint());
  }
  void TearDown() override { expect_alive(); }

  template <typename Body>
  void expect_error(std::string_view method,
                    const Body& body,
                    v1::ErrorCode code,
                    std::string_view field) {
    const v1::Error error = client_->error_of(method, body);
    EXPECT_EQ(error.code(), code) << error.message();
    EXPECT_EQ(error.field(), field) << error.message();
    EXPECT_FALSE(error.message().empty());
  }

  /// Sets a message's field by its name.
  template <typename Number>
  static void set(google::protobuf::Message* message, const std::string& name, Number value) {
    const auto* const field = message->GetDescriptor()->FindFieldByName(name);
    ASSERT_NE(field, nullptr) << name;
    if constexpr (std::is_floating_point_v<Number>) {
      message->GetReflection()->SetDouble(message, field, value);
    } else {
      message->GetReflection()->SetUInt32(message, field, value);
    }
  }

  std::unique_ptr<RawClient> client_;
};

TEST_F(MalformedTest, AMessageOfAnotherNumberOfFramesIsDataLoss) {
  for (const std::vector<std::string>& frames : std::vector<std::vector<std::string>>{
           {"x"}, {""}, {"a", "b", "c"}, std::vector<std::string>(500, "frame")}) {
    client_->send_frames(frames);
    const auto reply = client_->receive();
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->header.error().code(), v1::ERROR_CODE_DATA_LOSS);
    EXPECT_EQ(reply->header.error().field(), "frames");
  }
  EXPECT_EQ(server_->counters().malformed, 4U);
}

TEST_F(MalformedTest, AHeaderThatIsNoneIsDataLoss) {
  client_->send_frames({"\xff\xff\xff", "body"});
  const auto reply = client_->receive();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->header.error().code(), v1::ERROR_CODE_DATA_LOSS);
  EXPECT_EQ(reply->header.error().field(), "header");
}

TEST_F(MalformedTest, TheRequestIdComesBackWithTheError) {
  const RawReply reply = client_->ask(RawClient::header("Nonsense", 77), "");
  EXPECT_EQ(reply.header.request_id(), 77U);
  EXPECT_EQ(reply.header.error().code(), v1::ERROR_CODE_UNIMPLEMENTED);
  EXPECT_EQ(reply.header.error().field(), "method");
  // It says what there is.
  EXPECT_NE(reply.header.error().message().find("GetViews"), std::string::npos);
}

TEST_F(MalformedTest, AnotherProtocolVersionIsUnimplemented) {
  v1::RequestHeader header = RawClient::header("Hello");
  header.set_protocol_version(9);
  const RawReply reply = client_->ask(header, "");
  EXPECT_EQ(reply.header.error().code(), v1::ERROR_CODE_UNIMPLEMENTED);
  EXPECT_EQ(reply.header.error().field(), "protocol_version");
}

TEST_F(MalformedTest, ABodyThatIsNoneIsDataLossForEveryMethod) {
  const auto hello = client_->get<v1::HelloReply>("Hello", v1::HelloRequest());
  EXPECT_EQ(hello.methods_size(), 11);
  for (const std::string& method : hello.methods()) {
    const RawReply reply = client_->ask(RawClient::header(method), "\xff\xff\xff\xff");
    EXPECT_EQ(reply.header.error().code(), v1::ERROR_CODE_DATA_LOSS) << method;
    EXPECT_EQ(reply.header.error().field(), "body") << method;
  }
}

TEST_F(MalformedTest, RandomBodiesNeverEndTheServer) {
  Rng rng(1);
  const auto hello = client_->get<v1::HelloReply>("Hello", v1::HelloRequest());
  for (int i = 0; i < 300; ++i) {
    std::string body = i % 2 == 0 ? observation_request().SerializeAsString()
                                  : score_request("x", 3).SerializeAsString();
    body.resize(rng.below(body.size() + 1));
    for (std::uint64_t k = rng.below(5); k > 0 && !body.empty(); --k) {
      body[rng.below(body.size())] = static_cast<char>(rng.below(256));
    }
    const auto method = static_cast<int>(rng.below(11));
    client_->ask(RawClient::header(hello.methods(method)), body);
  }
}

TEST_F(MalformedTest, MapsAndObservationsThatAreNotThereAreNotFound) {
  v1::GetMapRequest map;
  map.set_map_id("attic");
  expect_error("GetMap", map, v1::ERROR_CODE_NOT_FOUND, "map_id");
  expect_error("Score", score_request("17", 1), v1::ERROR_CODE_NOT_FOUND, "observation_id");
  const std::string id = set_observation(*client_);
  expect_error("Score", score_request(id + "0", 1), v1::ERROR_CODE_NOT_FOUND, "observation_id");
  EXPECT_NE(client_->error_of("Score", score_request("17", 1)).hint().find("send it again"),
            std::string::npos);
  v1::JobStatusRequest job;
  job.set_job_id("nonsense");
  expect_error("JobStatus", job, v1::ERROR_CODE_NOT_FOUND, "job_id");
  // A job cannot be sent.
  EXPECT_EQ(client_->error_of("JobStatus", job).hint().find("send it"), std::string::npos);
}

TEST_F(MalformedTest, AnotherMapsFingerprintIsAFailedPrecondition) {
  v1::ScoreRequest score = score_request(set_observation(*client_), 1);
  score.set_fingerprint(std::string(16, '\7'));
  expect_error("Score", score, v1::ERROR_CODE_FAILED_PRECONDITION, "fingerprint");
  score.set_fingerprint(protocol::to_wire(site_->map().fingerprint));
  client_->get<v1::ScoreReply>("Score", score);
}

TEST_F(MalformedTest, PosesThatAreNotFiniteAreNamed) {
  v1::ScoreRequest score = score_request(set_observation(*client_), 5);
  score.mutable_poses()->set_x_m(3, kNan);
  expect_error("Score", score, v1::ERROR_CODE_INVALID_ARGUMENT, "poses.x_m");
  v1::GetViewsRequest views;
  views.set_map_id("room");
  *views.mutable_panoramas()->mutable_poses() = score.poses();
  expect_error("GetViews", views, v1::ERROR_CODE_INVALID_ARGUMENT, "panoramas.poses.x_m");
  views.mutable_panoramas()->mutable_poses()->set_x_m(3, 1.0);
  views.mutable_panoramas()->mutable_profile()->set_columns(7);
  expect_error("GetViews", views, v1::ERROR_CODE_INVALID_ARGUMENT, "panoramas.profile.columns");
}

TEST_F(MalformedTest, WhatIsWrongWithAPinholeIsAFieldOfTheMessage) {
  v1::GetViewsRequest good;
  good.set_map_id("room");
  v1::ExactPinholes& pinholes = *good.mutable_pinholes();
  *pinholes.mutable_poses() = score_request("", 1).poses();
  pinholes.set_columns(4);
  pinholes.set_rows(3);
  pinholes.set_fx_px(2.0);
  pinholes.set_fy_px(2.0);
  client_->get<v1::GetViewsReply>("GetViews", good);
  for (const char* const name : {"columns", "rows"}) {
    for (const std::uint32_t pixels : {0U, 5000U, 4'000'000'000U}) {
      v1::GetViewsRequest bad = good;
      set(bad.mutable_pinholes(), name, pixels);
      expect_error(
          "GetViews", bad, v1::ERROR_CODE_INVALID_ARGUMENT, std::string("pinholes.") + name);
    }
  }
  for (const char* const name : {"fx_px", "fy_px", "cx_px", "cy_px", "eye_height_m"}) {
    for (const double value : {kNan, -1e9, 1e9}) {
      v1::GetViewsRequest bad = good;
      set(bad.mutable_pinholes(), name, value);
      expect_error(
          "GetViews", bad, v1::ERROR_CODE_INVALID_ARGUMENT, std::string("pinholes.") + name);
    }
  }
}

TEST_F(MalformedTest, ANumberBeyondItsLimitIsToldAsItCame) {
  v1::GetViewsRequest views;
  views.set_map_id("room");
  *views.mutable_panoramas()->mutable_poses() = score_request("", 1).poses();
  for (const char* const name : {"columns", "rows"}) {
    protocol::to_wire(site_->profile()).Swap(views.mutable_panoramas()->mutable_profile());
    set(views.mutable_panoramas()->mutable_profile(), name, std::uint32_t{4'294'967'288});
    const v1::Error error = client_->error_of("GetViews", views);
    EXPECT_EQ(error.field(), std::string("panoramas.profile.") + name);
    EXPECT_NE(error.message().find("4294967288"), std::string::npos) << error.message();
  }
}

TEST_F(MalformedTest, AStampThatIsNotFiniteIsNamed) {
  v1::SetObservationRequest request = observation_request();
  for (const double stamp_s : {kNan, std::numeric_limits<double>::infinity()}) {
    request.set_stamp_s(stamp_s);
    expect_error("SetObservation", request, v1::ERROR_CODE_INVALID_ARGUMENT, "stamp_s");
  }
}

TEST_F(MalformedTest, ObservationsOfAnotherSizeAreNamed) {
  v1::SetObservationRequest request = observation_request();
  request.mutable_labels()->pop_back();
  expect_error("SetObservation", request, v1::ERROR_CODE_INVALID_ARGUMENT, "labels");
  request = observation_request();
  request.set_rows(request.rows() / 2);
  request.set_columns(request.columns() * 2);
  expect_error("SetObservation", request, v1::ERROR_CODE_INVALID_ARGUMENT, "labels");
  request = observation_request();
  request.set_labels(std::string(request.labels().size(), '\xff'));
  expect_error("SetObservation", request, v1::ERROR_CODE_INVALID_ARGUMENT, "labels");
}

TEST_F(MalformedTest, WeightsThatDoNotFitAreNamed) {
  v1::SetObservationRequest request = observation_request();
  request.set_weights_csv("this is, no table\n1");
  expect_error("SetObservation", request, v1::ERROR_CODE_INVALID_ARGUMENT, "weights_csv");
  request.set_weights_csv("observed,wall,none\nwall,1,0\n");
  expect_error("SetObservation", request, v1::ERROR_CODE_FAILED_PRECONDITION, "weights_csv");
}

TEST_F(MalformedTest, HugeCountsAreResourceExhausted) {
  server::ServerConfig config;
  config.limits.max_poses = 100;
  config.limits.max_distorted_poses = 10;
  config.limits.max_views = 10;
  config.limits.max_heat_map_cells = 20;
  config.limits.max_message_bytes = 100'000;
  start(config);
  client_ = std::make_unique<RawClient>(server_->endpoint());
  const std::string id = set_observation(*client_);
  expect_error("Score", score_request(id, 101), v1::ERROR_CODE_RESOURCE_EXHAUSTED, "poses");
  v1::ScoreRequest distorted = score_request(id, 11);
  for (int i = 0; i < 11; ++i) {
    distorted.mutable_affines()->add_a(i);
    distorted.mutable_affines()->add_b(0);
    distorted.mutable_affines()->add_k(0);
  }
  expect_error("Score", distorted, v1::ERROR_CODE_RESOURCE_EXHAUSTED, "poses");
  v1::GetViewsRequest views;
  views.set_map_id("room");
  *views.mutable_poses() = score_request(id, 11).poses();
  expect_error("GetViews", views, v1::ERROR_CODE_RESOURCE_EXHAUSTED, "poses");
  v1::HeatmapRequest heat;
  heat.set_map_id("room");
  heat.set_observation_id(id);
  expect_error("Heatmap", heat, v1::ERROR_CODE_RESOURCE_EXHAUSTED, "region");
  // Above the limit of a message but below where the connection is cut.
  const RawReply reply = client_->ask(RawClient::header("Hello"), std::string(150'000, 'x'));
  EXPECT_EQ(reply.header.error().code(), v1::ERROR_CODE_RESOURCE_EXHAUSTED);
  EXPECT_EQ(reply.header.error().field(), "body");
}

TEST_F(MalformedTest, ImagesOfTooManyPixelsAreResourceExhausted) {
  v1::GetViewsRequest views;
  views.set_map_id("room");
  *views.mutable_pinholes()->mutable_poses() = score_request("", 1).poses();
  views.mutable_pinholes()->set_columns(4000);
  views.mutable_pinholes()->set_rows(4000);
  views.mutable_pinholes()->set_fx_px(100.0);
  views.mutable_pinholes()->set_fy_px(100.0);
  expect_error("GetViews", views, v1::ERROR_CODE_RESOURCE_EXHAUSTED, "pinholes.rows");
}

TEST_F(MalformedTest, AQuestionWithoutATargetNamesIt) {
  v1::GetViewsRequest views;
  views.set_map_id("room");
  expect_error("GetViews", views, v1::ERROR_CODE_INVALID_ARGUMENT, "target");
  views.mutable_cells()->add_ix(3);
  views.mutable_cells()->add_iy(3);
  views.set_with_ranges(true);
  expect_error("GetViews", views, v1::ERROR_CODE_INVALID_ARGUMENT, "with_ranges");
}

TEST_F(MalformedTest, PrecomputeWithoutACacheDirectoryIsTheServersLackAndNoFieldsFault) {
  v1::StartPrecomputeRequest request;
  request.set_map_id("room");
  const v1::Error error = client_->error_of("StartPrecompute", request);
  EXPECT_EQ(error.code(), v1::ERROR_CODE_FAILED_PRECONDITION);
  EXPECT_EQ(error.field(), "");
  EXPECT_NE(error.message().find("--cache"), std::string::npos) << error.message();
  EXPECT_NE(error.hint().find("semview-server"), std::string::npos) << error.hint();
}

TEST_F(MalformedTest, PlacesOfAPrecomputeThatAreNoneAreNamed) {
  service::SiteConfig config = small_sites();
  config.cache_directory = folder_.path() / "cache";
  server_.reset();
  site_ = open_site(folder_.path() / "room", {}, config);
  start({});
  client_ = std::make_unique<RawClient>(server_->endpoint());
  v1::StartPrecomputeRequest request;
  request.set_map_id("room");
  request.mutable_reachable_from()->set_x_m(1000.0);
  expect_error("StartPrecompute", request, v1::ERROR_CODE_INVALID_ARGUMENT, "reachable_from");
  request.mutable_region()->set_x_min_m(1.0);
  expect_error("StartPrecompute", request, v1::ERROR_CODE_INVALID_ARGUMENT, "reachable_from");
  request.clear_reachable_from();
  expect_error("StartPrecompute", request, v1::ERROR_CODE_INVALID_ARGUMENT, "region");
  request.mutable_region()->set_x_min_m(1000.0);
  request.mutable_region()->set_x_max_m(1001.0);
  request.mutable_region()->set_y_max_m(1.0);
  expect_error("StartPrecompute", request, v1::ERROR_CODE_NOT_FOUND, "region");
}

}  // namespace
}  // namespace semview::test
