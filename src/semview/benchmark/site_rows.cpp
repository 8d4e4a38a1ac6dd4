// SPDX-License-Identifier: Apache-2.0
// What the service makes of the engines: precomputing, and the time until a map answers.
#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <stop_token>

#include <fmt/format.h>

#include "semview/benchmark/measurement.hpp"
#include "semview/benchmark/subject_site.hpp"
#include "semview/cache/lmdb_store.hpp"
#include "semview/service/precompute.hpp"

namespace semview::benchmark::detail {
namespace {

/// Embree precomputes one cell in so many: it takes that much longer.
constexpr std::size_t kEmbreeShare = 8;

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

/// With one engine, whatever the others cast with.
Status precompute(const Circumstances& in, Row& row, const std::string& engine, std::size_t cells) {
  SEMVIEW_TRY(const ScratchFolder folder, ScratchFolder::make());
  SEMVIEW_TRY(const std::filesystem::path map, bundle_of(in.subject, folder));
  service::SiteConfig config = config_of(in);
  config.engine = engine;
  SEMVIEW_TRY(const auto site, open_site(map, config, row));
  SEMVIEW_TRY(service::PrecomputePlan plan, service::plan_precompute(*site, {}));
  thin_out(plan.cells, cells);
  std::vector<double> storing, casting;
  // The first round warms up.
  for (int round = 0; round <= in.extent.turns.fewest_rounds; ++round) {
    SEMVIEW_TRY(const double stored_s,
                precompute_s(map, config, folder / fmt::format("cache_{}", round), cells));
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
  row.found = finding_of({ours, other, in.extent.turns.fewest_rounds, TurnsClock::kWall},
                         fmt::format("stored views equal cast ones; {}", row.engine));
  return {};
}

Status precompute_with_columns(const Circumstances& in, Row& row) {
  return precompute(in, row, "columns", in.extent.precomputed_cells);
}

Status precompute_with_embree(const Circumstances& in, Row& row) {
  return precompute(in, row, "embree", in.extent.precomputed_cells / kEmbreeShare);
}

/// From the map's files to the first view, and a view that is known already.
Status ready(const Circumstances& in, Row& row) {
  SEMVIEW_TRY(const ScratchFolder folder, ScratchFolder::make());
  SEMVIEW_TRY(const std::filesystem::path map, bundle_of(in.subject, folder));
  std::vector<double> open_s;
  double cold_s = 0.0, warm_s = 0.0;
  for (int round = 0; round < in.extent.turns.fewest_rounds; ++round) {
    const double begin_s = now_s();
    SEMVIEW_TRY(const auto site, open_site(map, config_of(in), row));
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
  found.unit = std::string("s");
  found.ours = open_s.front();
  found.ours_median = open_s[open_s.size() / 2];
  found.clock = std::string(name_of(TurnsClock::kWall));
  found.agreement = fmt::format("{}; then the first view in {}, again in {}",
                                row.engine,
                                shown(cold_s, "s"),
                                shown(warm_s, "s"));
  row.found = std::move(found);
  return {};
}

}  // namespace

std::vector<RowKind> site_rows() {
  return {
      {"precompute",
       "columns: precompute with storing; casting alone",
       {{"at least 70 %, then 90 %", 0.7, 0.9}},
       Plans::kFirst,
       false,
       precompute_with_columns},
      {"precompute_embree",
       "Embree: precompute with storing; casting alone",
       {{"at least 70 %, then 90 %", 0.7, 0.9}},
       Plans::kFirst,
       false,
       precompute_with_embree},
      {"ready",
       "map loaded, checked and ready to answer",
       {{"at most 1 s", 1.0, std::nullopt, true, true}},
       Plans::kAll,
       true,
       ready},
  };
}

}  // namespace semview::benchmark::detail
