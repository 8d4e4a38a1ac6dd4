// SPDX-License-Identifier: Apache-2.0
#include "learned_weights.hpp"

#include <memory>
#include <optional>

#include "guard.hpp"
#include "raw_classes.hpp"
#include "row_map.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/similarity/weight_learner.hpp"
#include "trial.hpp"

namespace semview::paper2017 {

std::vector<World> make_training_worlds(const WorldConfig& config, ThreadPool& pool) {
  std::vector<World> worlds(kLastTrainingWorld - kFirstTrainingWorld + 1);
  pool.parallel_for(worlds.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      worlds[i] = make_world(config, WorldSeeds::all(kFirstTrainingWorld + i));
    }
  });
  return worlds;
}

Result<similarity::WeightMatrix> learn_weights(std::span<const World> training,
                                               ClassSubset classes,
                                               const std::filesystem::path& directory,
                                               const std::string& engine) {
  Row plain;
  plain.classes = classes;
  std::optional<similarity::WeightLearner> learner;
  for (std::size_t i = 0; i < training.size(); ++i) {
    const std::uint64_t seed = kFirstTrainingWorld + i;
    SEMVIEW_TRY_STATUS(draw_world_plan(training[i].layout, seed, classes, true, directory));
    SEMVIEW_TRY(const std::shared_ptr<service::Site> site,
                open_row_map(plain, seed, true, directory, engine));
    const PanoramaCamera& camera = site->profile().camera;
    if (!learner) {
      learner.emplace(
          similarity::WeightLearnerConfig{}, raw_classes(), site->map().classes, camera);
    }
    const RowWorld cut = cut_world(training[i], plain, camera);
    for (std::size_t stop = 0; stop < cut.truth.size(); ++stop) {
      const std::optional<GridKey> key = PoseGrid::key(cut.truth[stop]);
      if (!key) continue;
      const CellIndex cells[] = {key->cell};
      SEMVIEW_TRY(const auto batch, site->views().views(cells));
      if (!batch.views.front()) continue;
      learner->add(cut.observations[stop].labels, batch.views.front()->to_labels(key->heading));
    }
  }
  if (!learner) return fail(ErrorCode::kFailedPrecondition, "no training worlds");
  return learner->matrix();
}

}  // namespace semview::paper2017
