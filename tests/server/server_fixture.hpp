// SPDX-License-Identifier: Apache-2.0
/// A server in this process, on a free port, with two rooms.
#pragma once

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "semview/protocol/map_wire.hpp"
#include "semview/protocol/score_wire.hpp"
#include "semview/protocol/view_wire.hpp"
#include "semview/v1/jobs.pb.h"
#include "server.hpp"
#include "server/held_view.hpp"
#include "server/raw_client.hpp"
#include "server/room.hpp"
#include "support/eventually.hpp"

namespace semview::test {

using semview::testing::eventually;

class ServerFixture : public ::testing::Test {
 protected:
  void SetUp() override {
    site_ = open_site(write_room(folder_.path(), "room"));
    start({});
  }

  /// Ends the server that there is and starts another.
  void start(server::ServerConfig config, const Clock& clock = steady_clock()) {
    server_.reset();
    if (config.bind == server::ServerConfig{}.bind) config.bind = "tcp://127.0.0.1:*";
    if (config.workers == 0) config.workers = 2;
    auto started = server::Server::start(config, registry_of({site_}), clock);
    ASSERT_TRUE(started) << started.error().message;
    server_ = *std::move(started);
  }

  /// The same room with other views or another cache.
  void restart_with(const service::SiteConfig& config) {
    server_.reset();
    site_ = open_site(folder_.path() / "room", {}, config);
    start({});
  }

  v1::SetObservationRequest observation_request() const {
    v1::SetObservationRequest request;
    protocol::to_wire(observation_at(*site_, {2.0, 1.0, 0.5}), &request);
    request.set_map_id("room");
    return request;
  }

  std::string set_observation(RawClient& client) const {
    return client.get<v1::SetObservationReply>("SetObservation", observation_request())
        .observation_id();
  }

  static v1::ScoreRequest score_request(const std::string& observation_id,
                                        std::size_t poses,
                                        HeadingMode mode = HeadingMode::kCompass) {
    v1::ScoreRequest request;
    protocol::to_wire(ScoreRequest{many_poses(poses), mode, false}, &request);
    request.set_map_id("room");
    request.set_observation_id(observation_id);
    return request;
  }

  static v1::GetViewsRequest view_request(const CellIndex& cell) {
    v1::GetViewsRequest request;
    request.set_map_id("room");
    request.mutable_cells()->add_ix(cell.ix);
    request.mutable_cells()->add_iy(cell.iy);
    return request;
  }

  /// A cell whose view no observation of ours needs.
  static constexpr CellIndex kQuietCell{5, 5};

  /// The server answers as it should.
  void expect_alive() const {
    RawClient client(server_->endpoint());
    EXPECT_EQ(client.get<v1::ListMapsReply>("ListMaps", v1::ListMapsRequest()).maps_size(), 1);
  }

  TemporaryFolder folder_;
  std::shared_ptr<service::Site> site_;
  ManualClock clock_;  ///< for servers whose time a test makes; outlives them
  std::unique_ptr<server::Server> server_;
};

}  // namespace semview::test
