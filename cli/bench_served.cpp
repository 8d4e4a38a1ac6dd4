// SPDX-License-Identifier: Apache-2.0
#include "bench_served.hpp"

#include <chrono>
#include <string>
#include <utility>

#include "client/lib/remote_score_source.hpp"
#include "client/lib/remote_view_source.hpp"
#include "server/server.hpp"

namespace semview::cli {
namespace {

class LoopbackSite final : public benchmark::ServedSite {
 public:
  static Result<std::unique_ptr<benchmark::ServedSite>> open(std::shared_ptr<service::Site> site,
                                                             std::size_t workers) {
    auto opened = std::make_unique<LoopbackSite>();
    opened->map_id_ = site->id();
    service::MapRegistry maps;
    SEMVIEW_TRY_STATUS(maps.add(std::move(site)));
    server::ServerConfig config;
    config.bind = "tcp://127.0.0.1:*";
    config.events = false;
    config.workers = workers;
    SEMVIEW_TRY(opened->server_, server::Server::start(config, std::move(maps)));
    opened->connection_.client_name = "semview bench";
    opened->connection_.endpoint = opened->server_->endpoint();
    opened->connection_.timeout = std::chrono::minutes(1);
    SEMVIEW_TRY(opened->views_,
                client::RemoteViewSource::open(opened->connection_, opened->map_id_));
    return opened;
  }

  ViewSource& views() override { return *views_; }
  std::uint64_t received_bytes() const override { return views_->received_bytes(); }
  Result<std::unique_ptr<ScoreSource>> scores(
      const similarity::WeightMatrix& weights) const override {
    return client::RemoteScoreSource::open(connection_, map_id_, weights);
  }

 private:
  std::string map_id_;
  client::ConnectionConfig connection_;
  std::unique_ptr<server::Server> server_;
  std::unique_ptr<client::RemoteViewSource> views_;
};

}  // namespace

benchmark::Serve serve_on_loopback() { return LoopbackSite::open; }

}  // namespace semview::cli
