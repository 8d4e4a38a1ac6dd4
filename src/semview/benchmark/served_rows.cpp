// SPDX-License-Identifier: Apache-2.0
// What the network costs: calls over TCP beside the same calls in this process.
#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/benchmark/measurement.hpp"
#include "semview/benchmark/scoring_task.hpp"
#include "semview/benchmark/subject_site.hpp"
#include "semview/core/random.hpp"
#include "semview/similarity/similarity_score_source.hpp"

namespace semview::benchmark::detail {
namespace {

/// Two sites of one map, one behind a server: neither finds what the other has cast.
struct BothSides {
  std::shared_ptr<service::Site> site;
  std::unique_ptr<ServedSite> served;
};

Result<BothSides> open_both(const Circumstances& in, Row& row) {
  if (!in.serve) return fail(ErrorCode::kUnavailable, "not installed: a server to measure");
  SEMVIEW_TRY(const ScratchFolder folder, ScratchFolder::make());
  SEMVIEW_TRY(const std::filesystem::path map, bundle_of(in.subject, folder));
  BothSides sides;
  SEMVIEW_TRY(sides.site, open_site(map, config_of(in), row));
  SEMVIEW_TRY(std::shared_ptr<service::Site> behind, service::Site::open(map, config_of(in)));
  SEMVIEW_TRY(sides.served, in.serve(std::move(behind), in.pool.threads()));
  return sides;
}

/// The client waits while others work, so the wall tells.
TurnsConfig by_the_wall(const Circumstances& in) {
  TurnsConfig turns = in.extent.turns;
  turns.clock = TurnsClock::kWall;
  return turns;
}

Status check_equal_views(const BothSides& sides, std::span<const CellIndex> cells) {
  SEMVIEW_TRY(const ViewBatch served, sides.served->views().views(cells));
  SEMVIEW_TRY(const ViewBatch local, sides.site->views().views(cells));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (served.views[i] == nullptr || *served.views[i] != *local.views[i]) {
      return fail(ErrorCode::kInternal,
                  fmt::format("results differ: the view of cell {}, {} and the one served",
                              cells[i].ix,
                              cells[i].iy));
    }
  }
  return {};
}

Contender asking(ViewSource& source, std::span<const CellIndex> cells) {
  return {1, [&source, cells](std::size_t) { static_cast<void>(source.views(cells)); }};
}

/// Every cell is asked for once on each side.
Status cold_view(const Circumstances& in, Row& row) {
  SEMVIEW_TRY(const BothSides sides, open_both(in, row));
  const std::vector<CellIndex> cells = in.subject.sample(in.extent.cold_cells);
  std::vector<double> ours, others;
  for (const CellIndex& cell : cells) {
    const auto asked_s = [&cell](ViewSource& source) -> Result<double> {
      const double begin_s = now_s();
      SEMVIEW_TRY_STATUS(source.views(std::span(&cell, 1)).map([](auto&&) {}));
      return now_s() - begin_s;
    };
    SEMVIEW_TRY(const double served_s, asked_s(sides.served->views()));
    SEMVIEW_TRY(const double local_s, asked_s(sides.site->views()));
    ours.push_back(served_s);
    others.push_back(local_s);
  }
  SEMVIEW_TRY_STATUS(check_equal_views(sides, cells));
  // The first one, which finds nothing warm, and the median of all.
  const auto timing = [](std::vector<double> seconds) {
    const double first_s = seconds.front();
    std::ranges::sort(seconds);
    return Timing{first_s, seconds[seconds.size() / 2]};
  };
  const auto rounds = static_cast<int>(cells.size());
  row.found = finding_of({timing(ours), timing(others), rounds, TurnsClock::kWall},
                         fmt::format("{} views equal; the first, in brackets the median of all; {}",
                                     cells.size(),
                                     row.engine));
  return {};
}

Status warm_view(const Circumstances& in, Row& row) {
  SEMVIEW_TRY(const BothSides sides, open_both(in, row));
  const std::vector<CellIndex> cell = in.subject.sample(1);
  SEMVIEW_TRY_STATUS(check_equal_views(sides, cell));
  row.found = finding_of(take_turns(asking(sides.served->views(), cell),
                                    asking(sides.site->views(), cell),
                                    in.pool,
                                    by_the_wall(in)),
                         "views equal");
  return {};
}

/// One request for many views beside a request for each: MB/s.
Status many_views(const Circumstances& in, Row& row) {
  SEMVIEW_TRY(const BothSides sides, open_both(in, row));
  const std::vector<CellIndex> cells = in.subject.sample(in.extent.served_cells);
  SEMVIEW_TRY_STATUS(check_equal_views(sides, cells));
  ViewSource& source = sides.served->views();
  const auto bytes_of = [&](const Contender& contender) {
    const std::uint64_t before = sides.served->received_bytes();
    contender.item(0);
    return static_cast<double>(sides.served->received_bytes() - before);
  };
  const Contender together = asking(source, cells);
  const Contender apart{1, [&source, &cells](std::size_t) {
                          for (const CellIndex& cell : cells) {
                            static_cast<void>(source.views(std::span(&cell, 1)));
                          }
                        }};
  const double bytes = bytes_of(together);
  const double bytes_apart = bytes_of(apart);
  const Turns turns = take_turns(together, apart, in.pool, by_the_wall(in));
  Finding found = finding_of(turns, "");
  const auto rate = [](double of_bytes, double seconds) { return 1e-6 * of_bytes / seconds; };
  found.unit = "MB/s";
  found.ours = rate(bytes, turns.ours.least_s);
  found.ours_median = rate(bytes, turns.ours.median_s);
  found.other = rate(bytes_apart, turns.other.least_s);
  found.other_median = rate(bytes_apart, turns.other.median_s);
  const auto count = static_cast<double>(cells.size());
  found.agreement = fmt::format("{} views equal, {:.0f} bytes each; {} a view",
                                cells.size(),
                                bytes / count,
                                shown(turns.ours.least_s / count, "s"));
  row.found = std::move(found);
  return {};
}

/// Poses anywhere in some free cells, most of them in cells of their own.
ScoreRequest compass_of(const std::vector<CellIndex>& cells, std::size_t count) {
  Rng rng(1, "served compass");
  ScoreRequest request{{}, HeadingMode::kCompass, false};
  for (std::size_t i = 0; i < count; ++i) {
    const Pose2 center = PoseGrid::center(cells[i % cells.size()]);
    request.poses.push_back({center.x_m + rng.uniform(-0.04, 0.04),
                             center.y_m + rng.uniform(-0.04, 0.04),
                             rng.uniform(-kPi, kPi)});
  }
  return request;
}

Status compass(const Circumstances& in, Row& row) {
  SEMVIEW_TRY(const BothSides sides, open_both(in, row));
  SEMVIEW_TRY(const ScoringTask task, scoring_task(in.subject, in.camera, 1));
  SEMVIEW_TRY(const auto served, sides.served->scores(task.weights));
  similarity::SimilarityScoreSource local(
      sides.site->views(), in.subject.map->classes, task.weights, sides.site->pool());
  SEMVIEW_TRY_STATUS(served->set_observation(task.observation));
  SEMVIEW_TRY_STATUS(local.set_observation(task.observation));
  const std::size_t poses = in.extent.served_poses;
  const ScoreRequest request = compass_of(in.subject.sample(poses), poses);
  SEMVIEW_TRY(const ScoreBatch ours, served->score(request));
  SEMVIEW_TRY(const ScoreBatch other, local.score(request));
  if (ours.sums != other.sums || ours.best_heading != other.best_heading) {
    return fail(ErrorCode::kInternal, "results differ: scores over TCP and in this process");
  }
  const auto scoring = [&request](ScoreSource& source) {
    return Contender{
        1, [&source, &request](std::size_t) { static_cast<void>(source.score(request)); }};
  };
  // Milliseconds each, on several threads: more rounds, until both have met an idle machine once.
  TurnsConfig config = by_the_wall(in);
  config.budget_s *= 4.0;
  const Turns turns = take_turns(scoring(*served), scoring(local), in.pool, config);
  Finding found = finding_of(turns, fmt::format("{} sums and headings equal", poses));
  found.ratio = turns.ours.least_s / turns.other.least_s;
  found.ratio_median = turns.ours.median_s / turns.other.median_s;
  row.found = std::move(found);
  return {};
}

}  // namespace

std::vector<RowKind> served_rows() {
  return {
      {"served_cold",
       "first cold view over TCP; in this process",
       {{"at most 5 ms", 5e-3, std::nullopt, true, true}},
       Plans::kFirst,
       true,
       cold_view},
      {"served_warm",
       "warm view over TCP; in this process",
       {{"at most 1 ms", 1e-3, std::nullopt, true, true}},
       Plans::kFirst,
       true,
       warm_view},
      {"served_views",
       "1000 warm views over TCP at once; a request each",
       {{"at least 125 MB/s, a gigabit line", 125.0, std::nullopt, false, true}},
       Plans::kFirst,
       false,
       many_views},
      {"served_compass",
       "compass of 2000 poses over TCP: how many times the time in this process",
       {{"at most 1.1x, then 1.03x", 1.1, 1.03, true}},
       Plans::kFirst,
       false,
       compass},
  };
}

}  // namespace semview::benchmark::detail
