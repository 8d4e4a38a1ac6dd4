// SPDX-License-Identifier: Apache-2.0
#include "model_options.hpp"

#include <array>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace semview::cli {
namespace {

constexpr std::array kDepthOptions{"--z-sdf",
                                   "--sigma-sdf",
                                   "--sigma-sem",
                                   "--effective-pixels",
                                   "--movable",
                                   "--max-depth",
                                   "--observed-voxel"};

}  // namespace

void add_model_options(CLI::App& verb, ModelOptions& options) {
  verb.add_option("--model",
                  options.model,
                  "What scores poses: `views`, label panoramas; or of depth images the distance to "
                  "the nearest surface (`sdf`), to the nearest thing of the same class (`sem`), or "
                  "both (`sdf_sem`); or `mixed`: views and sdf_sem")
      ->check(CLI::IsMember({"views", "sdf", "sem", "sdf_sem", "mixed"}))
      ->capture_default_str();
  add_depth_options(verb, options);
}

void add_depth_options(CLI::App& verb, ModelOptions& options) {
  verb.add_option("--z-sdf", options.z_sdf, "sdf_sem: share of the distance to surfaces, 0 to 1")
      ->capture_default_str();
  verb.add_option("--sigma-sdf", options.sigma_sdf_m, "Sigma of the distance to surfaces in m")
      ->capture_default_str();
  verb.add_option("--sigma-sem", options.sigma_sem_m, "Sigma of the distance to the class in m")
      ->capture_default_str();
  verb.add_option("--effective-pixels",
                  options.effective_pixels,
                  "How many independent pixels a depth image is worth")
      ->capture_default_str();
  verb.add_flag("--movable",
                options.movable,
                "sdf_sem: the share of the class is the map's `movable` of it, the rest that of "
                "surfaces");
  verb.add_option("--max-depth", options.reduction.max_depth_m, "Farther is not scored, m")
      ->capture_default_str();
  verb.add_option("--observed-voxel",
                  options.reduction.voxel_m,
                  "Edge of the voxels that points are counted into, m")
      ->capture_default_str();
}

Status check_model_options(const CLI::App& verb, const ModelOptions& options) {
  if (!scores_depth(options)) {
    for (const char* option : kDepthOptions) {
      if (verb.get_option(option)->count() == 0) continue;
      return fail(Error{ErrorCode::kInvalidArgument,
                        fmt::format("{}: needs a --model of depth, not views", option),
                        option});
    }
    return {};
  }
  if (!(options.effective_pixels > 0.0 && options.effective_pixels <= 1e6)) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("--effective-pixels {}: expected more than 0, at most 1000000",
                                  options.effective_pixels),
                      "--effective-pixels"});
  }
  return observation::validate(options.reduction);
}

DepthScoring depth_scoring(const ModelOptions& options) {
  return {is_mixed(options) ? ScoreModel::kSdfSem : *score_model(options.model),
          options.z_sdf,
          options.sigma_sdf_m,
          options.sigma_sem_m,
          options.movable};
}

}  // namespace semview::cli
