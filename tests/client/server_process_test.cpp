// SPDX-License-Identifier: Apache-2.0
/// The built program semview-server at work.
#include <csignal>

#include <sys/resource.h>

#include "client/lib/remote_maps.hpp"
#include "client/lib/remote_score_source.hpp"
#include "client/lib/remote_view_source.hpp"
#include "client/lib/typed_call.hpp"
#include "client/server_process_fixture.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/v1/jobs.pb.h"
#include "server/raw_client.hpp"

namespace semview::test {
namespace {

TEST_F(ServerProcessTest, ServesSeveralMapsAndLeavesOnSigterm) {
  for (const int number : {SIGTERM, SIGINT}) {
    const auto server = serve({"--map",
                               room_.string(),
                               "--map",
                               "twin=" + room_.string(),
                               "--bind",
                               "tcp://127.0.0.1:*"});
    client::Connection connection = connect();
    const auto maps = client::list_maps(connection);
    ASSERT_TRUE(maps) << maps.error().message;
    ASSERT_EQ(maps->size(), 2U);
    EXPECT_EQ(maps->at(0).id, "room");
    EXPECT_EQ(maps->at(1).id, "twin");
    server->signal(number);
    EXPECT_EQ(server->wait(), 0);
    EXPECT_EQ(server->errors().find("trusted networks"), std::string::npos);
  }
}

TEST_F(ServerProcessTest, WhatPeersSendWronglyIsNotWrittenToItsLog) {
  const auto server = serve({"--map", room_.string(), "--bind", "tcp://127.0.0.1:*"});
  v1::RequestHeader header = RawClient::header("Hello");
  header.set_client_name("\xff\xfe");
  RawClient client(endpoint_);
  for (const bool well_formed : {true, false}) {
    std::vector<std::string> frames{header.SerializeAsString(), ""};
    if (!well_formed) frames.emplace_back("one too many");
    client.send_frames(frames);
    const auto reply = client.receive();
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->header.error().code(), v1::ERROR_CODE_DATA_LOSS);
  }
  EXPECT_EQ(server->errors().find("UTF-8"), std::string::npos) << server->errors();
}

TEST_F(ServerProcessTest, ALimitOnFileSizesStopsStoringAndNotTheServer) {
  rlimit own{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &own), 0);
  const rlimit small{64 * 1024, own.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);  // children inherit it
  const auto server = serve({"--map",
                             room_.string(),
                             "--bind",
                             "tcp://127.0.0.1:*",
                             "--cache",
                             (folder_.path() / "cache").string()});
  setrlimit(RLIMIT_FSIZE, &own);
  client::ConnectionConfig config;
  config.endpoint = endpoint_;
  config.timeout = std::chrono::seconds(20);
  const auto source = client::RemoteViewSource::open(config, "room");
  ASSERT_TRUE(source) << source.error().message;
  const auto cells = open_site(room_, {}, default_sites())->cells().free_cells();
  for (int round = 0; round < 2; ++round) {
    const auto views = (*source)->views(cells);
    ASSERT_TRUE(views) << views.error().message;
  }
  client::Connection connection = connect();
  const auto stats =
      client::typed_call<v1::GetStatsReply>(connection, "GetStats", v1::GetStatsRequest());
  ASSERT_TRUE(stats);
  EXPECT_FALSE(stats->disk().storing());
  EXPECT_GT(stats->disk().refused(), 0U);
  server->signal(SIGTERM);
  EXPECT_EQ(server->wait(), 0);
}

TEST_F(ServerProcessTest, PrecomputesAndKeepsWhatItHasCast) {
  const std::vector<std::string> arguments = {"--map",
                                              room_.string(),
                                              "--bind",
                                              "tcp://127.0.0.1:*",
                                              "--cache",
                                              (folder_.path() / "cache").string()};
  std::uint64_t cast = 0;
  for (const bool again : {false, true}) {
    const auto server = serve(arguments);
    client::Connection connection = connect();
    const auto job =
        client::start_precompute(connection, {"room", client::Region{0.5, 0.5, 1.5, 1.5}, {}});
    ASSERT_TRUE(job) << job.error().message;
    Result<protocol::JobProgress> progress = client::job_status(connection, *job);
    EXPECT_TRUE(semview::testing::eventually([&] {
      progress = client::job_status(connection, *job);
      return !progress || progress->state == protocol::JobState::kDone;
    }));
    ASSERT_TRUE(progress) << progress.error().message;
    if (again) {
      EXPECT_EQ(progress->found_cells, cast);
      EXPECT_EQ(progress->cast_cells, 0U);
    } else {
      cast = progress->cast_cells;
      EXPECT_GT(cast, 0U);
    }
    server->signal(SIGTERM);
    EXPECT_EQ(server->wait(), 0);
  }
}

TEST_F(ServerProcessTest, AKilledServerComesBackUnderItsClients) {
  auto server = serve({"--map", room_.string(), "--bind", "tcp://127.0.0.1:*"});
  client::ConnectionConfig config;
  config.endpoint = endpoint_;
  config.timeout = std::chrono::seconds(20);
  auto site = open_site(room_, {}, default_sites());
  const auto source = client::RemoteScoreSource::open(
      config, "room", similarity::WeightMatrix::identity(site->map().classes));
  ASSERT_TRUE(source) << source.error().message;
  ASSERT_TRUE((*source)->set_observation(observation_at(*site, {1.0, 1.0, 0.0})));
  const ScoreRequest request{many_poses(100), HeadingMode::kCompass, false};
  const auto before = (*source)->score(request);
  ASSERT_TRUE(before);
  server->signal(SIGKILL);
  EXPECT_EQ(server->wait(), -SIGKILL);
  server = serve({"--map", room_.string(), "--bind", endpoint_});
  const auto after = (*source)->score(request);
  ASSERT_TRUE(after) << after.error().message;
  EXPECT_EQ(after->sums, before->sums);
}

}  // namespace
}  // namespace semview::test
