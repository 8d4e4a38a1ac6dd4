// SPDX-License-Identifier: Apache-2.0
/// `--model` and what belongs to it: which likelihood scores poses.
#pragma once

#include <string>

#include "semview/core/result.hpp"
#include "semview/observation/voxel_reduction.hpp"
#include "semview/view/score_model.hpp"

namespace CLI {
class App;
}

namespace semview::cli {

struct ModelOptions {
  std::string model = "views";
  double z_sdf = DepthScoring{}.z_sdf;
  double sigma_sdf_m = DepthScoring{}.sigma_sdf_m;
  double sigma_sem_m = DepthScoring{}.sigma_sem_m;
  double effective_pixels = 300.0;
  bool movable = false;
  observation::VoxelReductionConfig reduction = {};
};

/// Whether depth images are scored.
inline bool scores_depth(const ModelOptions& options) {
  return options.model != name(ScoreModel::kViews);
}

/// Whether views are scored.
inline bool scores_views(const ModelOptions& options) {
  return options.model == name(ScoreModel::kViews) || options.model == "mixed";
}

/// Whether views and depth images are scored together.
inline bool is_mixed(const ModelOptions& options) { return options.model == "mixed"; }

/// `--model` and the options of the models of depth; `options` must outlive the parse.
void add_model_options(CLI::App& verb, ModelOptions& options);
/// The latter alone.
void add_depth_options(CLI::App& verb, ModelOptions& options);

/// @errors kInvalidArgument: an option of depth models with views; numbers out of range.
Status check_model_options(const CLI::App& verb, const ModelOptions& options);

/// Of a depth model; of `mixed` that of its depth, sdf_sem.
DepthScoring depth_scoring(const ModelOptions& options);

}  // namespace semview::cli
