// SPDX-License-Identifier: Apache-2.0
#include "unit.hpp"

#include <memory>
#include <utility>

#include "row_map.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "trial.hpp"

namespace semview::paper2017 {
namespace {

Result<std::vector<TrialRecord>> run_method(const UnitSettings& settings,
                                            const Method& method,
                                            const Row& row,
                                            const RowWorld& world,
                                            std::uint64_t world_seed,
                                            ViewSource& views) {
  const similarity::WeightMatrix weights =
      method.weights == WeightsKind::kLearned
          ? settings.learned.at({row.classes, method.bands})
          : row_weights(*settings.hand, method.weights, row.classes);
  ThreadPool alone(1);
  std::vector<TrialRecord> records;
  for (const Start start : settings.starts) {
    for (int run = 1; run <= settings.runs; ++run) {
      TrialRecord record{row.id, method.id, start, world_seed, filter_seed(settings.seed, run), {}};
      SEMVIEW_TRY(record.stops,
                  run_trial(world, method, start, weights, views, alone, record.filter_seed));
      records.push_back(std::move(record));
    }
  }
  return records;
}

}  // namespace

std::uint64_t filter_seed(std::uint64_t seed, int run) {
  return 1000 * seed + static_cast<std::uint64_t>(run);
}

Result<std::vector<TrialRecord>> run_unit(const UnitSettings& settings,
                                          const std::vector<Method>& methods,
                                          const Row& row,
                                          const World& world,
                                          std::uint64_t world_seed) {
  std::vector<TrialRecord> records;
  // Methods are sorted by their plan: a site and its views are there for one plan at a time.
  for (const bool stacked : {false, true}) {
    std::shared_ptr<service::Site> site;
    RowWorld cut;
    for (const Method& method : methods) {
      if (method.stacked_plan != stacked) continue;
      if (!site) {
        SEMVIEW_TRY(site, open_row_map(row, world_seed, stacked, settings.plans, settings.engine));
        cut = cut_world(world, row, site->profile().camera);
        cut.free_cells = site->cells().free_cells();
        cut.map_classes = site->map().classes;
      }
      SEMVIEW_TRY(std::vector<TrialRecord> drives,
                  run_method(settings, method, row, cut, world_seed, site->views()));
      for (TrialRecord& drive : drives) records.push_back(std::move(drive));
    }
  }
  return records;
}

}  // namespace semview::paper2017
