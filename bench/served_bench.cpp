// SPDX-License-Identifier: Apache-2.0
// What the network costs: views and scores over TCP beside the same calls in-process. Server and
// client run in this process, on a real map.
//
//   bench_served [views|scores] [MAP_FOLDER]      default: both, maps/duplex_level1 of the source
//   tree
//
// Both sides take turns and have caches of their own; cold views are cast, warm ones lie in memory.
// Of each side the best round counts: on a busy machine only the ratio is worth reading.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "client/lib/remote_maps.hpp"
#include "client/lib/remote_score_source.hpp"
#include "client/lib/remote_view_source.hpp"
#include "semview/core/random.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/protocol/envelope.hpp"
#include "semview/protocol/view_wire.hpp"
#include "semview/service/site.hpp"
#include "semview/similarity/similarity_score_source.hpp"
#include "server.hpp"
#include "usage.hpp"

namespace semview {
namespace {

template <typename T>
T must(Result<T> result) {
  if (!result) {
    fmt::print(stderr, "bench_served: {}\n", result.error().message);
    std::exit(1);
  }
  return *std::move(result);
}

void must(const Status& status) {
  if (status) return;
  fmt::print(stderr, "bench_served: {}\n", status.error().message);
  std::exit(1);
}

/// Cells of a large GetViews.
constexpr std::size_t kMany = 1000;

/// Seconds of the best round.
struct Times {
  double served = std::numeric_limits<double>::infinity();
  double in_process = std::numeric_limits<double>::infinity();
};

template <typename Body>
double seconds_of(const Body& body) {
  const auto start = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Calls `served(round)` and `in_process(round)` in turn.
template <typename Served, typename InProcess>
Times compare(int rounds, const Served& served, const InProcess& in_process) {
  Times best;
  for (int round = 0; round < rounds; ++round) {
    best.served = std::min(best.served, seconds_of([&] { served(round); }));
    best.in_process = std::min(best.in_process, seconds_of([&] { in_process(round); }));
  }
  return best;
}

void print_rates(const std::string& what, std::size_t count, const Times& times) {
  const auto number = static_cast<double>(count);
  fmt::print("{:<36} {:>10.0f}/s {:>10.0f}/s {:>9.2f}\n",
             what,
             number / times.served,
             number / times.in_process,
             times.in_process / times.served);
}

/// GetViews as lists and packed: what one reply takes.
void compare_encodings(client::Connection& connection,
                       const std::string& map_id,
                       std::span<const CellIndex> cells) {
  constexpr int kRounds = 100;
  v1::GetViewsRequest request;
  request.set_map_id(map_id);
  protocol::to_wire(cells, request.mutable_cells());
  const auto call = [&](bool packed) {
    request.set_packed_runs(packed);
    const std::string body =
        must(connection.call("GetViews", request.SerializeAsString(), client::Repeat::kSafe));
    must(
        protocol::from_wire(must(protocol::parse<v1::GetViewsReply>(body, "reply")), cells.size()));
    return body.size();
  };
  std::size_t packed_bytes = 0;
  std::size_t list_bytes = 0;
  const Times times = compare(
      kRounds, [&](int) { packed_bytes = call(true); }, [&](int) { list_bytes = call(false); });
  const auto count = static_cast<double>(cells.size());
  fmt::print("warm views, {} a request: packed {:.0f}/s, {} B each; as lists {:.0f}/s, {} B each\n",
             cells.size(),
             count / times.served,
             packed_bytes / cells.size(),
             count / times.in_process,
             list_bytes / cells.size());
}

void compare_views(ViewSource& served, ViewSource& in_process, std::span<const CellIndex> cells) {
  constexpr int kColdRounds = 20;
  constexpr int kWarmRounds = 200;
  for (const std::size_t count : {std::size_t{1}, std::size_t{64}}) {
    const auto part = [&](int round) {
      return cells.subspan(static_cast<std::size_t>(round) * count, count);
    };
    print_rates(fmt::format("cold views, {} a request", count),
                count,
                compare(
                    kColdRounds,
                    [&](int round) { must(served.views(part(round))); },
                    [&](int round) { must(in_process.views(part(round))); }));
    print_rates(fmt::format("warm views, {} a request", count),
                count,
                compare(
                    kWarmRounds,
                    [&](int) { must(served.views(part(0))); },
                    [&](int) { must(in_process.views(part(0))); }));
    cells = cells.subspan(kColdRounds * count);
  }
  const auto thousand = cells.first(kMany);
  print_rates(fmt::format("warm views, {} a request", kMany),
              kMany,
              compare(
                  kWarmRounds,
                  [&](int) { must(served.views(thousand)); },
                  [&](int) { must(in_process.views(thousand)); }));
}

ScoreRequest compass_poses(std::span<const CellIndex> cells, std::size_t count) {
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

void compare_scores(ScoreSource& served,
                    ScoreSource& in_process,
                    std::span<const CellIndex> cells) {
  constexpr int kRounds = 60;
  for (const std::size_t count : {1, 100, 500, 2000}) {
    const ScoreRequest request = compass_poses(cells, count);
    ScoreBatch remote;
    ScoreBatch local;
    print_rates(fmt::format("warm compass scores, {} a request", count),
                count,
                compare(
                    kRounds,
                    [&](int) { remote = must(served.score(request)); },
                    [&](int) { local = must(in_process.score(request)); }));
    if (remote.sums != local.sums || remote.best_heading != local.best_heading) {
      fmt::print(stderr, "bench_served: the scores of {} poses differ\n", count);
      std::exit(1);
    }
  }
}

void run(const std::string& part, const std::string& folder) {
  const std::shared_ptr<service::Site> in_process = must(service::Site::open(folder, {}));
  service::MapRegistry maps;
  must(maps.add(must(service::Site::open(folder, {}))));
  server::ServerConfig config;
  config.bind = "tcp://127.0.0.1:*";
  const auto server = must(server::Server::start(config, std::move(maps)));
  client::ConnectionConfig to_server;
  to_server.endpoint = server->endpoint();
  to_server.timeout = std::chrono::minutes(5);
  const std::string& map_id = in_process->id();

  client::Connection connection = must(client::Connection::open(to_server));
  const auto list_maps = [&](int) { must(client::list_maps(connection)); };
  fmt::print("round trip (ListMaps): {:.3f} ms\n\n",
             1e3 * compare(2000, list_maps, [](int) {}).served);
  fmt::print("{:<36} {:>12} {:>12} {:>9}\n", "", "served", "in-process", "ratio");

  std::vector<CellIndex> cells = in_process->cells().free_cells();
  if (part != "scores") {
    const auto served_views = must(client::RemoteViewSource::open(to_server, map_id));
    compare_views(*served_views, in_process->views(), cells);
    compare_encodings(connection, map_id, std::span(cells).first(kMany));
  }
  if (part == "views") return;

  const ClassTable& classes = in_process->map().classes;
  const auto weights = similarity::WeightMatrix::identity(classes);
  const auto served_scores = must(client::RemoteScoreSource::open(to_server, map_id, weights));
  similarity::SimilarityScoreSource scores(
      in_process->views(), classes, weights, in_process->pool());
  const ViewBatch seen = must(in_process->views().views(std::span(&cells[cells.size() / 2], 1)));
  const Observation observation{classes, seen.views[0]->to_labels(40), 0.0};
  print_rates("SetObservation",
              1,
              compare(
                  50,
                  [&](int) { must(served_scores->set_observation(observation)); },
                  [&](int) { must(scores.set_observation(observation)); }));
  compare_scores(*served_scores, scores, cells);
}

}  // namespace
}  // namespace semview

int main(int argc, char** argv) {
  constexpr const char* kUsage =
      "bench_served [views|scores] [MAP]\n"
      "Views and scores of a map (default: duplex_level1) over TCP beside the same calls "
      "in-process.";
  if (const auto code = semview::bench::explain(argc, argv, kUsage)) return *code;
  const std::string first = argc > 1 ? argv[1] : "";
  const bool part = first == "views" || first == "scores";
  const int folder = part ? 2 : 1;
  semview::run(
      part ? first : "",
      argc > folder ? argv[folder] : std::string(SEMVIEW_SOURCE_DIR) + "/maps/duplex_level1");
  return 0;
}
