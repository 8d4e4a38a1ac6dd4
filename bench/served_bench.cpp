// SPDX-License-Identifier: Apache-2.0
// What the network costs: round trips, views and a 2000-pose compass over TCP, beside the same call
// in-process. Server and client run in this process, on a real map.
//
//   bench_served [MAP_FOLDER]      default: maps/duplex_level1 of the source tree
//
// Remote and in-process calls take turns; the least times are printed, and their ratio: on a busy
// machine only that is worth reading.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "client/lib/remote_maps.hpp"
#include "client/lib/remote_score_source.hpp"
#include "client/lib/remote_view_source.hpp"
#include "semview/core/random.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/service/site.hpp"
#include "semview/similarity/similarity_score_source.hpp"
#include "server.hpp"

namespace semview {
namespace {

double milliseconds_of(const std::function<void()>& body) {
  const auto start = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

double least(int repetitions, const std::function<void()>& body) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repetitions; ++i) best = std::min(best, milliseconds_of(body));
  return best;
}

template <typename T>
T must(Result<T> result) {
  if (!result) {
    fmt::print(stderr, "bench_served: {}\n", result.error().message);
    std::exit(1);
  }
  return *std::move(result);
}

ScoreRequest compass_poses(const service::Site& site, std::size_t count) {
  const std::vector<CellIndex> cells = site.cells().free_cells();
  Rng rng(1);
  ScoreRequest request{{}, HeadingMode::kCompass, false};
  for (std::size_t i = 0; i < count; ++i) {
    const Pose2 center = PoseGrid::center(cells[rng.below(cells.size())]);
    request.poses.push_back({center.x_m + rng.uniform(-0.04, 0.04),
                             center.y_m + rng.uniform(-0.04, 0.04),
                             rng.uniform(-kPi, kPi)});
  }
  return request;
}

void compare_scores(ScoreSource& remote, ScoreSource& local, const ScoreRequest& request) {
  double remote_ms = std::numeric_limits<double>::infinity();
  double local_ms = remote_ms;
  ScoreBatch remote_batch;
  ScoreBatch local_batch;
  for (int i = 0; i < 30; ++i) {
    remote_ms =
        std::min(remote_ms, milliseconds_of([&] { remote_batch = must(remote.score(request)); }));
    local_ms =
        std::min(local_ms, milliseconds_of([&] { local_batch = must(local.score(request)); }));
  }
  const bool equal = remote_batch.sums == local_batch.sums &&
                     remote_batch.best_heading == local_batch.best_heading;
  fmt::print("compass, {:5} poses: served {:7.2f} ms, in-process {:7.2f} ms, {:.2f}x, {}\n",
             request.poses.size(),
             remote_ms,
             local_ms,
             remote_ms / local_ms,
             equal ? "equal bits" : "DIFFERENT");
}

int run(const std::string& folder) {
  const std::shared_ptr<service::Site> site = must(service::Site::open(folder, {}));
  service::MapRegistry maps;
  if (!maps.add(site)) return 1;
  server::ServerConfig config;
  config.bind = "tcp://127.0.0.1:*";
  const auto server = must(server::Server::start(config, std::move(maps)));
  client::ConnectionConfig to_server;
  to_server.endpoint = server->endpoint();
  to_server.timeout = std::chrono::minutes(5);

  client::Connection connection = must(client::Connection::open(to_server));
  must(client::list_maps(connection));
  fmt::print("round trip (ListMaps): {:.3f} ms\n",
             least(2000, [&] { must(client::list_maps(connection)); }));

  const auto views = must(client::RemoteViewSource::open(to_server, site->id()));
  const std::vector<CellIndex> cells = site->cells().free_cells();
  std::size_t next = 0;
  const double cold = least(50, [&] { must(views->views(std::span(&cells[next++ * 7], 1))); });
  const double warm = least(500, [&] { must(views->views(std::span(cells.data(), 1))); });
  fmt::print("one view over TCP: cold {:.3f} ms, warm {:.3f} ms\n", cold, warm);

  const auto weights = similarity::WeightMatrix::identity(site->map().classes);
  const auto remote = must(client::RemoteScoreSource::open(to_server, site->id(), weights));
  similarity::SimilarityScoreSource local(
      site->views(), site->map().classes, weights, site->pool());
  const auto seen = must(site->views().views(std::span(&cells[cells.size() / 2], 1)));
  const Observation observation{site->map().classes, seen.views[0]->to_labels(40), 0.0};
  double set_ms = least(50, [&] { static_cast<void>(remote->set_observation(observation)); });
  fmt::print("SetObservation: {:.3f} ms\n", set_ms);
  set_ms = least(50, [&] { static_cast<void>(local.set_observation(observation)); });
  fmt::print("the same in-process: {:.3f} ms\n", set_ms);
  for (const std::size_t count : {1, 100, 500, 2000, 20'000}) {
    compare_scores(*remote, local, compass_poses(*site, count));
  }
  return 0;
}

}  // namespace
}  // namespace semview

int main(int argc, char** argv) {
  return semview::run(argc > 1 ? argv[1] : std::string(SEMVIEW_SOURCE_DIR) + "/maps/duplex_level1");
}
