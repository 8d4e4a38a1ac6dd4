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
                                               int bands,
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
      learner.emplace(similarity::WeightLearnerConfig{.bands = bands},
                      raw_classes(),
                      site->map().classes,
                      camera);
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

Result<LearnedWeights> learn_weights(std::span<const World> training,
                                     const std::map<ClassSubset, std::set<int>>& kinds,
                                     const std::filesystem::path& directory,
                                     const std::string& engine,
                                     ThreadPool& pool) {
  // Bands one after the other: those of one subset draw the same plans.
  const std::vector<std::pair<ClassSubset, std::set<int>>> subsets(kinds.begin(), kinds.end());
  std::vector<std::vector<Result<similarity::WeightMatrix>>> learned(subsets.size());
  pool.parallel_for(subsets.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (const int bands : subsets[i].second) {
        learned[i].push_back(learn_weights(training, subsets[i].first, bands, directory, engine));
      }
    }
  });
  LearnedWeights weights;
  for (std::size_t i = 0; i < subsets.size(); ++i) {
    auto next = learned[i].begin();
    for (const int bands : subsets[i].second) {
      SEMVIEW_TRY(similarity::WeightMatrix matrix, *std::move(next));
      weights.emplace(std::pair(subsets[i].first, bands), std::move(matrix));
      ++next;
    }
  }
  return weights;
}

}  // namespace semview::paper2017
