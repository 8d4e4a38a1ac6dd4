// SPDX-License-Identifier: Apache-2.0
// What storing costs beside casting: `bench_precompute MAP` (default: maps/duplex_level1).
//
// The parts of a precompute take turns in one process and thread; the least time of each is
// printed, the thread's own and by the clock: on a busy machine only ratios of the first are worth
// reading, but waiting for the disk shows only in the second.
#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "semview/cache/lmdb_store.hpp"
#include "semview/cache/record.hpp"
#include "semview/service/precompute.hpp"
#include "semview/service/site.hpp"
#include "semview/view/view_codec.hpp"

namespace semview {
namespace {

constexpr std::size_t kCells = 256;
constexpr int kRounds = 12;

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
  std::vector<SharedView> views;
  std::vector<cache::EncodedView> encoded;
  std::uint64_t decoded_runs = 0;
  std::vector<Part> parts = {
      {"cast", [&] { views = (*(*site)->engine_views().views(cells)).views; }},
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
  const double cast = parts[0].least_s;
  const double all = cast + parts[1].least_s + parts[2].least_s;
  fmt::print("precompute with storing reaches {:.0f} % of the caster's rate\n", 100 * cast / all);
  fmt::print("{} bytes a record\n", record_bytes / kCells);
  std::error_code ignored;
  std::filesystem::remove_all(directory, ignored);
  return 0;
}

}  // namespace
}  // namespace semview

int main(int argc, char** argv) {
  return semview::run(argc > 1 ? argv[1] : SEMVIEW_SOURCE_DIR "/maps/duplex_level1");
}
