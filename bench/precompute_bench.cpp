// SPDX-License-Identifier: Apache-2.0
// What storing costs beside casting: `bench_precompute MAP` (default: maps/duplex_level1).
//
// The parts of a precompute take turns in one process and thread; the least time of each is
// printed, the thread's own and by the clock: on a busy machine only ratios of the first are worth
// reading, but waiting for the disk shows only in the second. Then whole runs are timed by the
// clock, with one and two threads, each in turn with casting the same cells and keeping nothing.
#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
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
#include "usage.hpp"

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
Status compare_runs(const std::filesystem::path& map, std::size_t threads) {
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
    SEMVIEW_TRY(const auto site, service::Site::open(map, config));
    SEMVIEW_TRY(service::PrecomputePlan plan, service::plan_precompute(*site, {}));
    plan.cells.resize(std::min(plan.cells.size(), kRunCells));
    cast.work = [&] { static_cast<void>(site->engine_views().views(plan.cells)); };
    run.work = [&] { static_cast<void>(service::run_precompute(*site, plan, {}, {})); };
    cast.run();
    run.run();
    file_bytes = site->tiers().store->file_bytes() / plan.cells.size();
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
  return {};
}

/// Cells spread over the whole map.
/// @errors kInvalidArgument: it has too few.
Result<std::vector<CellIndex>> sample_cells(const service::Site& site) {
  SEMVIEW_TRY(const service::PrecomputePlan plan, service::plan_precompute(site, {}));
  if (plan.cells.size() < kCells) {
    return fail(
        ErrorCode::kInvalidArgument,
        fmt::format(
            "{}: {} free cells; expected {} at least", site.id(), plan.cells.size(), kCells));
  }
  std::vector<CellIndex> cells;
  for (std::size_t i = 0; i < kCells; ++i) {
    cells.push_back(plan.cells[i * plan.cells.size() / kCells]);
  }
  return cells;
}

/// What casting and storing some cells consists of.
class Precomputing {
 public:
  Precomputing(const service::Site& site, cache::LmdbStore& store, std::vector<CellIndex> cells)
      : site_(site), store_(store), cells_(std::move(cells)) {
    if (const map::ColumnMap* const plan = site.map().columns()) {
      columns_.emplace(raycast::ColumnScene::build(*plan));
    }
  }

  void run_and_print() {
    Part cast{"cast", [this] { views_ = site_.engine_views().views(cells_)->views; }};
    Part columns{"cast with columns", [this] { cast_all_with_columns(); }};
    Part encode{"encode", [this] { encode_all(); }};
    Part store{"store, one commit", [this] { store_all(); }};
    Part decode{"check and decode", [this] { decode_all(); }};
    const std::array parts{&cast, &columns, &encode, &store, &decode};
    for (int round = 0; round < kRounds; ++round) {
      for (Part* part : parts) part->run();
    }
    for (const Part* part : parts) {
      fmt::print("{:<18} {:8.1f} us a view, {:8.1f} by the clock\n",
                 part->name,
                 part->least_s / kCells * 1e6,
                 part->least_clock_s / kCells * 1e6);
    }
    const double storing_s = encode.least_s + store.least_s;
    for (const Part* caster : {&cast, &columns}) {
      fmt::print("{} with storing reaches {:.0f} % of the caster's rate\n",
                 caster->name,
                 100 * caster->least_s / (caster->least_s + storing_s));
    }
    std::uint64_t record_bytes = 0;
    for (const cache::EncodedView& view : encoded_) record_bytes += view.record.size();
    fmt::print("{} bytes a record\n", record_bytes / kCells);
  }

 private:
  void cast_all_with_columns() {
    if (!columns_) return;
    for (const CellIndex& cell : cells_) cast_with_columns(*columns_, site_, cell);
  }

  void encode_all() {
    const Fingerprint name = cache::digest(site_.keyspace());
    encoded_.clear();
    for (std::size_t i = 0; i < kCells; ++i) {
      encoded_.push_back(cache::LmdbStore::encode(name, cells_[i], *views_[i]));
    }
  }

  /// As another version each round: the same bytes again would not be written.
  void store_all() {
    cache::Keyspace fresh = site_.keyspace();
    fresh.engine_version += ++stored_;
    static_cast<void>(store_.put_encoded(fresh, encoded_));
  }

  void decode_all() {
    for (const cache::EncodedView& view : encoded_) {
      const auto record = cache::decode_record(view.record);
      decoded_runs_ += decode_view(record->codec, record->payload, {360, 90, false})->runs().size();
    }
  }

  const service::Site& site_;
  cache::LmdbStore& store_;
  const std::vector<CellIndex> cells_;
  std::optional<raycast::ColumnScene> columns_;
  std::vector<SharedView> views_;
  std::vector<cache::EncodedView> encoded_;
  std::uint32_t stored_ = 0;
  std::uint64_t decoded_runs_ = 0;
};

Status run(const std::filesystem::path& map) {
  const std::filesystem::path directory =
      std::filesystem::temp_directory_path() / fmt::format("bench_precompute_{}", getpid());
  service::SiteConfig config;
  config.threads = 1;
  SEMVIEW_TRY(const auto site, service::Site::open(map, config));
  SEMVIEW_TRY(std::vector<CellIndex> cells, sample_cells(*site));
  {
    SEMVIEW_TRY(const auto store, cache::LmdbStore::open({directory}));
    Precomputing(*site, *store, std::move(cells)).run_and_print();
  }
  std::error_code ignored;
  std::filesystem::remove_all(directory, ignored);
  for (const std::size_t threads : {1U, 2U}) SEMVIEW_TRY_STATUS(compare_runs(map, threads));
  return {};
}

}  // namespace
}  // namespace semview

int main(int argc, char** argv) {
  constexpr const char* kUsage =
      "bench_precompute [MAP]\n"
      "What storing costs beside casting, of some cells of a map (default: duplex_level1): the "
      "parts\n"
      "of a precompute, then whole runs with one and two threads.";
  if (const auto code = semview::bench::explain(argc, argv, kUsage)) return *code;
  const semview::Status status =
      semview::run(argc > 1 ? argv[1] : SEMVIEW_SOURCE_DIR "/maps/duplex_level1");
  if (status) return 0;
  fmt::print(stderr, "bench_precompute: {}\n", status.error().message);
  return 1;
}
