// SPDX-License-Identifier: Apache-2.0
// What storing costs beside casting: `bench_precompute MAP` (default: maps/duplex_level1).
//
// The parts of a precompute take turns in one process and thread; the least time of each is
// printed, the thread's own and by the clock: on a busy machine only ratios of the first are worth
// reading, but waiting for the disk shows only in the second. Then whole runs are timed by the
// clock, with one and two threads, each in turn with casting the same cells and keeping nothing.
#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "semview/cache/lmdb_store.hpp"
#include "semview/cache/record.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/column_renderer.hpp"
#include "semview/raycast/column_scene.hpp"
#include "semview/service/precompute.hpp"
#include "semview/service/site.hpp"
#include "semview/view/view_codec.hpp"

namespace semview {
namespace {

constexpr std::size_t kCells = 256;
constexpr int kRounds = 12;
constexpr std::size_t kRunCells = 1024;
constexpr int kRuns = 4;

double thread_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The least times of some work over all rounds.
struct Part {
  std::string name;
  std::function<void()> work;
  double least_s = std::numeric_limits<double>::infinity();  ///< of the thread
  double least_clock_s = std::numeric_limits<double>::infinity();

  void run() {
    const auto start = std::chrono::steady_clock::now();
    const double thread_start_s = thread_s();
    work();
    least_s = std::min(least_s, thread_s() - thread_start_s);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    least_clock_s = std::min(least_clock_s, elapsed.count());
  }
};

void cast_with_columns(const raycast::ColumnScene& scene,
                       const service::Site& site,
                       const CellIndex& cell) {
  const ViewProfile& profile = site.profile();
  raycast::PanoramaRequest request;
  request.map_from_robot = PoseGrid::center(cell);
  request.eye_z_m = site.eye_z_m(profile.eye_height_m);
  request.camera = profile.camera;
  static_cast<void>(raycast::render_column_view(scene, request, profile.ranges));
}

/// Whole runs over some cells, each into a new directory.
int compare_runs(const std::filesystem::path& map, std::size_t threads) {
  const std::filesystem::path directory =
      std::filesystem::temp_directory_path() / fmt::format("bench_precompute_{}_runs", getpid());
  Part cast{"cast", {}};
  Part run{"precompute", {}};
  std::error_code ignored;
  std::uint64_t file_bytes = 0;
  for (int round = 0; round < kRuns; ++round) {
    std::filesystem::remove_all(directory, ignored);
    service::SiteConfig config;
    config.threads = threads;
    config.cache_directory = directory;
    const auto site = service::Site::open(map, config);
    if (!site) return 1;
    auto plan = service::plan_precompute(**site, {});
    if (!plan) return 1;
    plan->cells.resize(std::min(plan->cells.size(), kRunCells));
    cast.work = [&] { static_cast<void>((*site)->engine_views().views(plan->cells)); };
    run.work = [&] { static_cast<void>(service::run_precompute(**site, *plan, {}, {})); };
    cast.run();
    run.run();
    file_bytes = (*site)->tiers().store->file_bytes() / plan->cells.size();
  }
  std::filesystem::remove_all(directory, ignored);
  fmt::print(
      "{} threads: {:.0f} views/s cast, {:.0f} cast and stored, {:.0f} %; {} bytes of file a "
      "view\n",
      threads,
      static_cast<double>(kRunCells) / cast.least_clock_s,
      static_cast<double>(kRunCells) / run.least_clock_s,
      100 * cast.least_clock_s / run.least_clock_s,
      file_bytes);
  return 0;
}

int run(const std::filesystem::path& map) {
  const std::filesystem::path directory =
      std::filesystem::temp_directory_path() / fmt::format("bench_precompute_{}", getpid());
  service::SiteConfig config;
  config.threads = 1;
  const auto site = service::Site::open(map, config);
  if (!site) {
    fmt::print(stderr, "{}\n", site.error().message);
    return 1;
  }
  const auto plan = service::plan_precompute(**site, {});
  const auto store = cache::LmdbStore::open({directory});
  if (!plan || !store || plan->cells.size() < kCells) return 1;
  std::vector<CellIndex> cells;
  for (std::size_t i = 0; i < kCells; ++i) {
    cells.push_back(plan->cells[i * plan->cells.size() / kCells]);
  }

  const cache::Keyspace& keyspace = (*site)->keyspace();
  const Fingerprint name = cache::digest(keyspace);
  const map::ColumnMap* const extruded = (*site)->map().columns();
  const auto columns =
      extruded == nullptr ? std::nullopt : std::optional(raycast::ColumnScene::build(*extruded));
  std::vector<SharedView> views;
  std::vector<cache::EncodedView> encoded;
  std::uint64_t decoded_runs = 0;
  std::vector<Part> parts = {
      {"cast", [&] { views = (*(*site)->engine_views().views(cells)).views; }},
      {"cast with columns",
       [&] {
         if (!columns) return;
         for (const CellIndex& cell : cells) cast_with_columns(*columns, **site, cell);
       }},
      {"encode",
       [&] {
         encoded.clear();
         for (std::size_t i = 0; i < kCells; ++i) {
           encoded.push_back(cache::LmdbStore::encode(name, cells[i], *views[i]));
         }
       }},
      {"store, one commit",
       [&] {
         // Another version each round: the same bytes again would not be written.
         cache::Keyspace fresh = keyspace;
         fresh.engine_version += static_cast<std::uint32_t>(decoded_runs) + 1;
         static_cast<void>((*store)->put_encoded(fresh, encoded));
       }},
      {"check and decode",
       [&] {
         for (const cache::EncodedView& view : encoded) {
           const auto record = cache::decode_record(view.record);
           decoded_runs +=
               decode_view(record->codec, record->payload, {360, 90, false})->runs().size();
         }
       }},
  };
  for (int round = 0; round < kRounds; ++round) {
    for (Part& part : parts) part.run();
  }
  std::uint64_t record_bytes = 0;
  for (const cache::EncodedView& view : encoded) record_bytes += view.record.size();
  for (const Part& part : parts) {
    fmt::print("{:<18} {:8.1f} us a view, {:8.1f} by the clock\n",
               part.name,
               part.least_s / kCells * 1e6,
               part.least_clock_s / kCells * 1e6);
  }
  const double storing = parts[2].least_s + parts[3].least_s;
  for (const std::size_t caster : {0U, 1U}) {
    const double cast = parts[caster].least_s;
    fmt::print("{} with storing reaches {:.0f} % of the caster's rate\n",
               parts[caster].name,
               100 * cast / (cast + storing));
  }
  fmt::print("{} bytes a record\n", record_bytes / kCells);
  std::error_code ignored;
  std::filesystem::remove_all(directory, ignored);
  return compare_runs(map, 1) + compare_runs(map, 2);
}

}  // namespace
}  // namespace semview

int main(int argc, char** argv) {
  return semview::run(argc > 1 ? argv[1] : SEMVIEW_SOURCE_DIR "/maps/duplex_level1");
}
