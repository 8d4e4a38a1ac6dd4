// SPDX-License-Identifier: Apache-2.0
// What the service makes of the engines: precomputing, and the time until a map answers.
#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <stop_token>

#include <fmt/format.h>
#include <unistd.h>

#include "semview/benchmark/measurement.hpp"
#include "semview/benchmark/office_plan.hpp"
#include "semview/cache/lmdb_store.hpp"
#include "semview/service/precompute.hpp"
#include "semview/service/site.hpp"

namespace semview::benchmark::detail {
namespace {

/// A folder that goes with this object.
class ScratchFolder {
 public:
  ScratchFolder()
      : path_(std::filesystem::temp_directory_path() / fmt::format("semview_bench_{}", getpid())) {}
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// The subject's map as files: its own, or the office written down.
Result<std::filesystem::path> bundle_of(const Subject& subject, const ScratchFolder& folder) {
  if (!subject.office) {
    std::error_code ignored;
    const bool bare = !std::filesystem::exists(subject.map->directory / "map.yaml", ignored);
    return bare ? subject.map->mesh()->file : subject.map->directory;
  }
  SEMVIEW_TRY_STATUS(write_office(*subject.office, folder / "map"));
  return folder / "map";
}

service::SiteConfig config_of(const Circumstances& in) {
  service::SiteConfig config;
  config.profile.camera = in.camera;
  config.profile.eye_height_m = kEyeHeight_m;
  config.threads = in.pool.threads();
  return config;
}

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// As many cells of a plan as are asked for, spread over all of it row by row.
void thin_out(std::vector<CellIndex>& cells, std::size_t count) {
  count = std::min(count, cells.size());
  std::vector<CellIndex> kept;
  for (std::size_t i = 0; i < count; ++i) kept.push_back(cells[i * cells.size() / count]);
  cells = std::move(kept);
}

/// Seconds a view of casting and storing into a new cache; and whether what is stored there is
/// what the engine casts.
Result<double> precompute_s(const std::filesystem::path& map,
                            service::SiteConfig config,
                            const std::filesystem::path& directory,
                            std::size_t cells) {
  config.cache_directory = directory;
  SEMVIEW_TRY(const auto site, service::Site::open(map, config));
  SEMVIEW_TRY(service::PrecomputePlan plan, service::plan_precompute(*site, {}));
  thin_out(plan.cells, cells);
  const double begin_s = now_s();
  SEMVIEW_TRY_STATUS(
      service::run_precompute(*site, plan, std::stop_token(), {}).map([](auto&&) {}));
  const double seconds = (now_s() - begin_s) / static_cast<double>(plan.cells.size());
  const std::size_t compared = std::min<std::size_t>(plan.cells.size(), 16);
  const std::span<const CellIndex> some(plan.cells.data(), compared);
  const auto stored = site->tiers().store->get(site->keyspace(), some);
  SEMVIEW_TRY(const ViewBatch cast, site->engine_views().views(some));
  for (std::size_t i = 0; i < compared; ++i) {
    if (stored[i] == nullptr || *stored[i] != *cast.views[i]) {
      return fail(ErrorCode::kInternal, "results differ: a stored view and the one cast");
    }
  }
  return seconds;
}

Status precompute(const Circumstances& in, Row& row) {
  const ScratchFolder folder;
  SEMVIEW_TRY(const std::filesystem::path map, bundle_of(in.subject, folder));
  const service::SiteConfig config = config_of(in);
  SEMVIEW_TRY(const auto site, service::Site::open(map, config));
  SEMVIEW_TRY(service::PrecomputePlan plan, service::plan_precompute(*site, {}));
  thin_out(plan.cells, in.extent.precomputed_cells);
  std::vector<double> storing, casting;
  // The first round warms up.
  for (int round = 0; round <= in.extent.turns.fewest_rounds; ++round) {
    SEMVIEW_TRY(
        const double stored_s,
        precompute_s(
            map, config, folder / fmt::format("cache_{}", round), in.extent.precomputed_cells));
    const double begin_s = now_s();
    SEMVIEW_TRY_STATUS(site->engine_views().views(plan.cells).map([](auto&&) {}));
    if (round == 0) continue;
    casting.push_back((now_s() - begin_s) / static_cast<double>(plan.cells.size()));
    storing.push_back(stored_s);
  }
  std::ranges::sort(storing);
  std::ranges::sort(casting);
  const Timing ours{storing.front(), storing[storing.size() / 2]};
  const Timing other{casting.front(), casting[casting.size() / 2]};
  row.found = finding_of({ours, other, in.extent.turns.fewest_rounds},
                         fmt::format("stored views equal cast ones; {}", site->engine().name));
  return {};
}

/// From the map's files to the first view, and a view that is known already.
Status ready(const Circumstances& in, Row& row) {
  const ScratchFolder folder;
  SEMVIEW_TRY(const std::filesystem::path map, bundle_of(in.subject, folder));
  std::vector<double> open_s;
  double cold_s = 0.0, warm_s = 0.0;
  for (int round = 0; round < in.extent.turns.fewest_rounds; ++round) {
    const double begin_s = now_s();
    SEMVIEW_TRY(const auto site, service::Site::open(map, config_of(in)));
    open_s.push_back(now_s() - begin_s);
    const std::vector<CellIndex> cell = in.subject.sample(1);
    for (double* seconds : {&cold_s, &warm_s}) {
      const double asked_s = now_s();
      SEMVIEW_TRY_STATUS(site->views().views(cell).map([](auto&&) {}));
      *seconds = now_s() - asked_s;
    }
  }
  std::ranges::sort(open_s);
  Finding found;
  found.unit = "s";
  found.ours = open_s.front();
  found.ours_median = open_s[open_s.size() / 2];
  found.agreement =
      fmt::format("then the first view in {}, again in {}", shown(cold_s, "s"), shown(warm_s, "s"));
  row.found = std::move(found);
  return {};
}

}  // namespace

std::vector<RowKind> site_rows() {
  return {
      {"precompute",
       "precompute with storing; casting alone",
       {{"at least 0.7x", 0.7}},
       Plans::kFirst,
       false,
       precompute},
      {"ready",
       "map loaded, checked and ready to answer",
       {{"at most 1 s", 1.0, true, true}},
       Plans::kAll,
       true,
       ready},
  };
}

}  // namespace semview::benchmark::detail
