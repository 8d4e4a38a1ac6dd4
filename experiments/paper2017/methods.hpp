// SPDX-License-Identifier: Apache-2.0
/// The ways of localizing that are compared.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/localization/affine_state.hpp"
#include "semview/localization/annealed_start.hpp"
#include "semview/localization/heading_strategy.hpp"
#include "semview/localization/kld_sampling.hpp"
#include "semview/localization/pose_estimate.hpp"
#include "semview/localization/position_noise_model.hpp"
#include "semview/localization/recovery.hpp"
#include "semview/observation/combined_heading.hpp"
#include "semview/observation/similarity_weighting.hpp"

namespace semview::paper2017 {

enum class WeightsKind {
  kIdentity,  ///< 1 where names mean the same, else 0
  kHand,      ///< the paper's concepts, weights/paper2017_ade20k150.csv
  kLearned,   ///< log-likelihood ratios learned on training worlds
};

struct Method {
  std::string id;
  std::string title;
  WeightsKind weights = WeightsKind::kHand;
  int bands = 4;  ///< of elevation, if weights are learned here
  bool stacked_plan = false;
  localization::HeadingStrategy heading = localization::HeadingStrategy::kCompass;
  /// Whether the compass turns the next odometry step: 0 never, 1 always.
  double compass_gain = 0.0;
  observation::SimilarityWeightingConfig weighting = {.power = 16.0};
  observation::CombinedHeadingConfig combined = {};
  localization::PositionNoiseConfig motion = {.heading_sigma_rad = rad_from_deg(0.3)};
  std::optional<localization::AffineStateConfig> affine = {};  ///< none: the map is exact
  std::optional<localization::KldConfig> kld = {};             ///< none: as many as at the start
  std::optional<localization::RecoveryConfig> recovery = {};   ///< newcomers: anywhere
  bool refine = false;  ///< the estimate is moved to the top of the image's similarity
  /// none: an unknown start is 2000 particles drawn evenly, weighed by the first image.
  std::optional<localization::AnnealedStartConfig> annealed_start = {};
  double start_sigma_m = 0.1;
  double start_heading_sigma_rad = rad_from_deg(3.0);
  /// The estimate that tables call "best".
  localization::EstimateKind estimate = localization::EstimateKind::kHighestWeight;
};

/// The frozen baselines, the steps from them to ours, ours without one idea each (ids that begin
/// with "without_") and ours with one that it leaves out ("with_").
const std::vector<Method>& all_methods();

/// Whether it is ours with one idea less or more.
bool is_ablated(std::string_view id);

/// Null if there is none of that id.
const Method* find_method(std::string_view id);

/// Methods by their ids; "ablation" stands for ours and for ours with one idea less or more.
/// @errors kInvalidArgument: a method twice, or an unknown id; the message lists the known ones.
Result<std::vector<Method>> methods_by_id(std::span<const std::string> ids);

/// Every setting in one line: equal methods have equal texts.
std::string describe(const Method& method);

enum class Start {
  kLocal,   ///< 500 particles around the known pose
  kGlobal,  ///< 2000 particles over all free cells, any heading
};

inline constexpr std::size_t kLocalParticles = 500;
inline constexpr std::size_t kGlobalParticles = 2000;

/// "local" or "global".
std::string_view name(Start start);

}  // namespace semview::paper2017
