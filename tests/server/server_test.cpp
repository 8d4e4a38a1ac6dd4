// SPDX-License-Identifier: Apache-2.0
#include "server.hpp"

#include "semview/core/thread_pool.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/similarity/heat_map.hpp"
#include "semview/similarity/score_poses.hpp"
#include "server/server_fixture.hpp"

namespace semview::test {
namespace {

class ServerTest : public ServerFixture {
 protected:
  similarity::PreparedObservation prepared() const {
    auto made = similarity::PreparedObservation::build(
        observation_at(*site_, {2.0, 1.0, 0.5}),
        similarity::WeightMatrix::identity(site_->map().classes),
        site_->map().classes,
        site_->profile().camera);
    EXPECT_TRUE(made);
    return *std::move(made);
  }
};

TEST_F(ServerTest, HelloTellsVersionMethodsAndLimits) {
  RawClient client(server_->endpoint());
  const auto hello = client.get<v1::HelloReply>("Hello", v1::HelloRequest());
  EXPECT_EQ(hello.protocol_version(), protocol::kProtocolVersion);
  EXPECT_EQ(hello.limits().poses(), service::Limits{}.max_poses);
  EXPECT_GT(hello.events_port(), 0U);
}

TEST_F(ServerTest, AReqClientWithItsDelimiterIsServed) {
  RawClient client(server_->endpoint(), zmq::socket_type::req);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(client.get<v1::ListMapsReply>("ListMaps", v1::ListMapsRequest()).maps(0).id(),
              "room");
  }
}

TEST_F(ServerTest, ADealerWithADelimiterGetsItBack) {
  RawClient client(server_->endpoint());
  client.send_frames({"", RawClient::header("Hello").SerializeAsString(), ""});
  const auto reply = client.receive();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->frames, 3U);
  EXPECT_FALSE(reply->header.has_error());
}

TEST_F(ServerTest, GetMapTellsWhatTheSiteIs) {
  RawClient client(server_->endpoint());
  v1::GetMapRequest request;
  request.set_map_id("room");
  request.set_with_glb(true);
  const auto map = protocol::from_wire(client.get<v1::GetMapReply>("GetMap", request));
  ASSERT_TRUE(map);
  EXPECT_EQ(map->summary.fingerprint, site_->map().fingerprint);
  EXPECT_EQ(map->classes, site_->map().classes);
  EXPECT_EQ(map->profile, site_->profile());
  EXPECT_EQ(map->free_cells, site_->cells().free_cells());
  EXPECT_EQ(map->engine, testing::plan_engine());
  EXPECT_EQ(map->engine_version, site_->engine().version);
  EXPECT_EQ(map->engine_reason, site_->engine().reason);
  EXPECT_FALSE(map->engine_reason.empty());
  EXPECT_EQ(map->colors[2], (Rgb{120, 120, 120}));
  EXPECT_EQ(map->glb.substr(0, 4), "glTF");
}

TEST_F(ServerTest, SeveralMapsAreServedSideBySide) {
  const auto other = open_site(write_room(folder_.path(), "other", 2.0), "annex");
  server_.reset();
  server::ServerConfig config;
  config.bind = "tcp://127.0.0.1:*";
  auto started = server::Server::start(config, registry_of({site_, other}));
  ASSERT_TRUE(started);
  RawClient client((*started)->endpoint());
  const auto maps = client.get<v1::ListMapsReply>("ListMaps", v1::ListMapsRequest());
  ASSERT_EQ(maps.maps_size(), 2);
  EXPECT_EQ(maps.maps(0).id(), "annex");
  EXPECT_EQ(maps.maps(1).id(), "room");
  EXPECT_NE(maps.maps(0).fingerprint(), maps.maps(1).fingerprint());
  v1::GetViewsRequest request;
  request.mutable_cells()->add_ix(20);
  request.mutable_cells()->add_iy(10);
  for (const auto& site : {site_, other}) {
    request.set_map_id(site->id());
    const auto views = client.get<v1::GetViewsReply>("GetViews", request);
    const auto batch = protocol::from_wire(views, 1);
    const auto own = site->views().views(std::vector<CellIndex>{{20, 10}});
    ASSERT_TRUE(batch && own);
    EXPECT_EQ(*batch->views[0], *own->views[0]);
  }
  // An observation is for the map that it was set for.
  const std::string id = set_observation(client);
  v1::ScoreRequest score = score_request(id, 1);
  score.set_map_id("annex");
  EXPECT_EQ(client.error_of("Score", score).field(), "observation_id");
}

TEST_F(ServerTest, ScoresAreThoseOfTheCallInProcess) {
  RawClient client(server_->endpoint());
  const std::string id = set_observation(client);
  const similarity::PreparedObservation observation = prepared();
  ThreadPool pool(2);
  for (const HeadingMode mode : {HeadingMode::kAsGiven, HeadingMode::kCompass}) {
    // Repeated, in no order of cells, some without a view.
    ScoreRequest request{many_poses(1500), mode, mode == HeadingMode::kCompass};
    v1::ScoreRequest wire;
    protocol::to_wire(request, &wire);
    wire.set_map_id("room");
    wire.set_observation_id(id);
    const auto remote = protocol::from_wire(client.get<v1::ScoreReply>("Score", wire), request);
    const auto local = similarity::score_poses(observation, site_->views(), request, pool);
    ASSERT_TRUE(remote) << remote.error().message;
    ASSERT_TRUE(local);
    EXPECT_EQ(remote->sums, local->sums);
    EXPECT_EQ(remote->best_heading, local->best_heading);
    EXPECT_EQ(remote->curve, local->curve);
    EXPECT_EQ(remote->weight_scale, local->weight_scale);
    EXPECT_EQ(remote->observed_pixels, local->observed_pixels);
    EXPECT_EQ(remote->origins.total(), local->origins.total());
    EXPECT_TRUE(std::count(remote->sums.begin(), remote->sums.end(), kNoView) > 0);
  }
}

TEST_F(ServerTest, TheHeatMapIsThatOfTheCallInProcess) {
  RawClient client(server_->endpoint());
  v1::HeatmapRequest request;
  request.set_map_id("room");
  request.set_observation_id(set_observation(client));
  request.set_headings(24);
  const auto remote = client.get<v1::HeatmapReply>("Heatmap", request);
  ThreadPool pool(1);
  const auto local =
      similarity::heat_map(prepared(), site_->views(), site_->cells().free_cells(), 24, pool);
  ASSERT_TRUE(local);
  ASSERT_EQ(remote.rows(), static_cast<std::uint32_t>(local->similarity.rows()));
  ASSERT_EQ(remote.columns(), static_cast<std::uint32_t>(local->similarity.columns()));
  EXPECT_EQ(remote.origin_ix(), local->origin.ix);
  EXPECT_EQ(remote.origin_iy(), local->origin.iy);
  for (int i = 0; i < remote.similarity_size(); ++i) {
    const float mine = local->similarity.pixels()[static_cast<std::size_t>(i)];
    const float theirs = remote.similarity(i);
    EXPECT_TRUE(mine == theirs || (std::isnan(mine) && std::isnan(theirs))) << i;
    EXPECT_EQ(static_cast<std::uint8_t>(remote.best_headings()[static_cast<std::size_t>(i)]),
              local->best_heading.pixels()[static_cast<std::size_t>(i)]);
  }
}

TEST_F(ServerTest, AHeatMapOfARegionHoldsNothingElse) {
  RawClient client(server_->endpoint());
  v1::HeatmapRequest request;
  request.set_map_id("room");
  request.set_observation_id(set_observation(client));
  request.mutable_region()->set_x_min_m(1.0);
  request.mutable_region()->set_y_min_m(0.5);
  request.mutable_region()->set_x_max_m(2.0);
  request.mutable_region()->set_y_max_m(1.0);
  const auto heat = client.get<v1::HeatmapReply>("Heatmap", request);
  EXPECT_EQ(heat.columns(), 10U);
  EXPECT_EQ(heat.rows(), 5U);
  EXPECT_EQ(heat.origin_ix(), 10);
  EXPECT_EQ(heat.origin_iy(), 5);
}

TEST_F(ServerTest, GridViewsAreTurnedToTheHeadingOfThePose) {
  RawClient client(server_->endpoint());
  v1::GetViewsRequest request;
  request.set_map_id("room");
  const std::vector<Pose2> poses = {
      {1.05, 1.0, 0.0}, {1.05, 1.0, rad_from_deg(90.0)}, {-9.0, -9.0, 0.0}};
  protocol::to_wire(poses, request.mutable_poses());
  for (const auto& [encoding, packed] : {std::pair(v1::VIEW_ENCODING_RUNS, false),
                                         std::pair(v1::VIEW_ENCODING_RUNS, true),
                                         std::pair(v1::VIEW_ENCODING_PIXELS, true)}) {
    request.set_encoding(encoding);
    request.set_packed_runs(packed);
    const auto reply = client.get<v1::GetViewsReply>("GetViews", request);
    ASSERT_EQ(reply.views_size(), 3);
    EXPECT_TRUE(reply.views(2).no_view());
    for (int i = 0; i < 2; ++i) {
      const auto key = PoseGrid::key(poses[static_cast<std::size_t>(i)]);
      const auto own = site_->views().views(std::vector{key->cell});
      const LabelImage expected = own->views[0]->to_labels(key->heading);
      if (encoding == v1::VIEW_ENCODING_PIXELS) {
        EXPECT_EQ(reply.views(i).labels(), protocol::to_bytes(expected.pixels()));
      } else {
        EXPECT_EQ(reply.views(i).runs().packed().empty(), !packed);
        const auto view = protocol::from_wire(reply.views(i).runs(), 30, 120);
        ASSERT_TRUE(view);
        EXPECT_EQ(view->to_labels(), expected);
      }
    }
  }
}

TEST_F(ServerTest, ViewsOfAGridWithRangesAreStoredAndSentWithThem) {
  service::SiteConfig config = small_sites();
  config.profile.ranges = true;
  config.cache_directory = folder_.path() / "cache";
  restart_with(config);
  const CellIndex cell = site_->cells().free_cells()[7];
  const ViewProfile& profile = site_->profile();
  const auto cast = site_->exact_panorama(
      {PoseGrid::center(cell), site_->eye_z_m(profile.eye_height_m), profile.camera, {}});
  ASSERT_TRUE(cast);
  RawClient client(server_->endpoint());
  v1::GetViewsRequest request;
  request.set_map_id("room");
  protocol::to_wire(std::vector{cell}, request.mutable_cells());
  for (const bool packed : {false, true}) {
    request.set_packed_runs(packed);
    request.set_with_ranges(true);
    auto reply = client.get<v1::GetViewsReply>("GetViews", request);
    const auto view = protocol::from_wire(reply.views(0).runs(), 30, 120);
    ASSERT_TRUE(view) << view.error().message;
    ASSERT_TRUE(view->has_ranges());
    EXPECT_EQ(view->to_labels(), cast->labels);
    const RangeImage ranges_m = view->to_ranges(profile.camera);
    for (std::size_t i = 0; i < ranges_m.pixels().size(); ++i) {
      const float range_m = cast->ranges_m.pixels()[i];
      if (ranges_m.pixels()[i] == range_m) continue;  // both infinite
      ASSERT_NEAR(ranges_m.pixels()[i], range_m, 1e-3F) << i;
    }
    request.set_with_ranges(false);
    reply = client.get<v1::GetViewsReply>("GetViews", request);
    EXPECT_EQ(*protocol::from_wire(reply.views(0).runs(), 30, 120),
              ColumnView::from_labels(cast->labels));
  }
  // What was stored gives the same, pixel for pixel.
  request.set_encoding(v1::VIEW_ENCODING_PIXELS);
  request.set_with_ranges(true);
  const auto fresh = client.get<v1::GetViewsReply>("GetViews", request);
  restart_with(config);
  RawClient again(server_->endpoint());
  const auto stored = again.get<v1::GetViewsReply>("GetViews", request);
  EXPECT_EQ(stored.origins().disk(), 1U);
  ASSERT_EQ(stored.views(0).ranges_m_size(), 30 * 120);
  EXPECT_EQ(stored.views(0).SerializeAsString(), fresh.views(0).SerializeAsString());
}

TEST_F(ServerTest, ExactPanoramasAndPinholesComeWithRanges) {
  RawClient client(server_->endpoint());
  v1::GetViewsRequest request;
  request.set_map_id("room");
  request.set_with_ranges(true);
  request.set_encoding(v1::VIEW_ENCODING_PIXELS);
  const Pose2 pose{1.234, 0.777, 0.321};
  protocol::to_wire(std::vector{pose}, request.mutable_panoramas()->mutable_poses());
  auto reply = client.get<v1::GetViewsReply>("GetViews", request);
  const auto panorama = site_->exact_panorama(
      {pose, site_->eye_z_m(site_->profile().eye_height_m), site_->profile().camera, {}});
  ASSERT_TRUE(panorama);
  EXPECT_EQ(reply.views(0).labels(), protocol::to_bytes(panorama->labels.pixels()));
  ASSERT_EQ(reply.views(0).ranges_m_size(), 30 * 120);
  EXPECT_TRUE(std::equal(reply.views(0).ranges_m().begin(),
                         reply.views(0).ranges_m().end(),
                         panorama->ranges_m.pixels().begin()));

  v1::ExactPinholes* const pinholes = request.mutable_pinholes();
  protocol::to_wire(std::vector{Pose2{1.0, 2.5, 0.0}}, pinholes->mutable_poses());
  pinholes->set_columns(3);
  pinholes->set_rows(3);
  pinholes->set_fx_px(100.0);
  pinholes->set_fy_px(100.0);
  pinholes->set_cx_px(1.5);
  pinholes->set_cy_px(1.5);
  reply = client.get<v1::GetViewsReply>("GetViews", request);
  // The middle pixel looks along x, from 1 m to the wall's face at 3.9 m.
  EXPECT_EQ(reply.views(0).labels()[4], static_cast<char>(*site_->map().classes.id("wall")));
  EXPECT_NEAR(reply.views(0).ranges_m(4), 2.9F, 1e-5F);
}

TEST_F(ServerTest, AnAddressInUseIsAnErrorThatNamesIt) {
  server::ServerConfig config;
  config.bind = server_->endpoint();
  const auto second = server::Server::start(config, registry_of({site_}));
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kUnavailable);
  EXPECT_NE(second.error().message.find(config.bind), std::string::npos);
  config.bind = "udp://127.0.0.1:1";
  EXPECT_EQ(server::Server::start(config, registry_of({site_})).error().field, "--bind");
}

TEST_F(ServerTest, ProgressOfAPrecomputeIsPublishedAndAskedFor) {
  service::SiteConfig config = small_sites();
  config.cache_directory = folder_.path() / "cache";
  server_.reset();
  site_ = open_site(folder_.path() / "room", {}, config);
  start({});
  RawClient client(server_->endpoint());

  zmq::context_t context;
  zmq::socket_t events(context, zmq::socket_type::sub);
  events.set(zmq::sockopt::linger, 0);
  events.set(zmq::sockopt::rcvtimeo, 20'000);
  events.set(zmq::sockopt::subscribe, "job/");
  events.connect(server_->events_endpoint());

  v1::StartPrecomputeRequest request;
  request.set_map_id("room");
  v1::Event event;
  std::string job_id;
  // A subscription takes a moment to arrive: jobs are run until one is heard of.
  events.set(zmq::sockopt::rcvtimeo, 200);
  v1::JobStatusRequest status;
  for (int i = 0; i < 100 && job_id.empty(); ++i) {
    status.set_job_id(client.get<v1::StartPrecomputeReply>("StartPrecompute", request).job_id());
    ASSERT_TRUE(eventually([&] {
      return client.get<v1::JobStatusReply>("JobStatus", status).state() == v1::JOB_STATE_DONE;
    }));
    zmq::message_t frame;
    while (events.recv(frame)) {
      EXPECT_TRUE(frame.more());
      EXPECT_TRUE(frame.to_string_view().starts_with("job/"));
      ASSERT_TRUE(events.recv(frame));
      ASSERT_TRUE(event.ParseFromArray(frame.data(), static_cast<int>(frame.size())));
      if (event.job().job_id() == status.job_id() && event.job().state() == v1::JOB_STATE_DONE) {
        job_id = status.job_id();
        break;
      }
    }
  }
  ASSERT_FALSE(job_id.empty());
  EXPECT_EQ(event.job().found_cells() + event.job().cast_cells(), event.job().total_cells());
  const auto reply = client.get<v1::JobStatusReply>("JobStatus", status);
  EXPECT_EQ(reply.state(), v1::JOB_STATE_DONE);
  EXPECT_GE(reply.total_cells(), site_->cells().free_count() / 2);
  v1::CancelJobRequest cancel;
  cancel.set_job_id(job_id);
  client.get<v1::CancelJobReply>("CancelJob", cancel);
  v1::GetViewsRequest view;
  view.set_map_id("room");
  view.mutable_cells()->add_ix(10);
  view.mutable_cells()->add_iy(20);
  EXPECT_EQ(client.get<v1::GetViewsReply>("GetViews", view).origins().disk(), 1U);
  const auto stats = client.get<v1::GetStatsReply>("GetStats", v1::GetStatsRequest());
  EXPECT_EQ(stats.views_from_disk(), 1U);
  EXPECT_EQ(stats.views_cast(), 0U);
  EXPECT_EQ(stats.cells_by_client().count("raw"), 1U);
}

}  // namespace
}  // namespace semview::test
