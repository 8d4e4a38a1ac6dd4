// SPDX-License-Identifier: Apache-2.0
/// The options of `semview localize`, and what they make of the filter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "client/robot/localizer.hpp"
#include "model_options.hpp"
#include "semview/localization/affine_state.hpp"
#include "semview/localization/kld_sampling.hpp"
#include "semview/localization/odometry_motion_model.hpp"
#include "semview/localization/particle_set.hpp"
#include "semview/localization/position_noise_model.hpp"
#include "semview/localization/recovery.hpp"
#include "semview/observation/mixed_score_source.hpp"
#include "site_options.hpp"
#include "weighting_options.hpp"

namespace semview::cli {

/// As given on the command line; docs/localization.md explains each.
struct LocalizeOptions {
  std::string log;
  std::string server;  ///< empty: in this process
  std::string map;     ///< a folder or file in this process, an id with --server
  std::string weights;
  std::string segment;  ///< the network that labels the log's images; empty: the log has labels
  std::string output;
  ModelOptions model = {};
  std::uint64_t seed = 1;
  std::size_t particles = 0;  ///< 0: see `particles_of`
  std::string init;
  double init_heading_sigma_deg = 10.0;
  std::string global;   ///< empty: the start is known; "sampled" or "dense"
  std::string heading;  ///< empty: see `heading_of`
  std::string motion = "odometry";
  localization::OdometryMotionConfig alphas = {};
  double sigma_m = localization::PositionNoiseConfig{}.sigma_m;
  double heading_sigma_deg = 0.0;
  WeightingOptions weighting = {};
  std::string estimate = "mode";
  double resample_threshold = localization::ParticleFilterConfig{}.resample_threshold;
  std::optional<double> compass_gain = {};      ///< none: as `--heading` has it
  std::optional<double> compass_gate_deg = {};  ///< none: as `--heading` has it
  double combined_sigma_deg = 0.0;
  double combined_lost = observation::CombinedHeadingConfig{}.lost_probability;
  bool refine = false;
  bool estimate_map_affine = false;
  localization::AffineStateConfig affine = {};
  bool kld = false;
  localization::KldConfig kld_sampling = {};
  std::string recovery;  ///< empty: none; "uniform" or "dense"
  localization::RecoveryConfig recovery_rates = {};
  double rate = 0.0;
  double timeout_s = 5.0;
  bool json = false;
  SiteOptions site = {};
};

/// --global dense: the first observation is compared with every free cell.
inline bool is_dense(const LocalizeOptions& options) { return options.global == "dense"; }

/// `--heading`, or what stands for it: a distortion is told well only by particles whose headings
/// follow what is seen without leaving odometry.
inline std::string heading_of(const LocalizeOptions& options) {
  if (!options.heading.empty()) return options.heading;
  if (options.estimate_map_affine) return "combined";
  return options.global == "sampled" && !scores_depth(options.model) ? "compass" : "odometry";
}

/// `--particles`, or what stands for it: unknown starts and distortions want more.
inline std::size_t particles_of(const LocalizeOptions& options) {
  if (options.particles > 0) return options.particles;
  if (scores_depth(options.model)) return 3000;
  return options.global.empty() && !options.estimate_map_affine ? 500 : 2000;
}

/// Declares the options; `options` must outlive the parse.
void add_localize_options(CLI::App& verb, LocalizeOptions& options);

/// What belongs together, and what the numbers may be.
/// @errors kInvalidArgument, with the option as the field.
Status check_localize_options(const CLI::App& verb, const LocalizeOptions& options);

/// Of --model mixed.
observation::MixedConfig mixed_config(const LocalizeOptions& options);

/// @errors kInvalidArgument, with the option as the field.
Result<robot::LocalizerConfig> localizer_config(const LocalizeOptions& options);
Result<std::shared_ptr<const localization::MotionModel>> motion_model(
    const LocalizeOptions& options);

}  // namespace semview::cli
