// SPDX-License-Identifier: Apache-2.0
#include "semview/field/field_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace semview::field {
namespace {

/// d² / 2σ², no more than at kReachSigmas.
float exponent(float distance_m, double sigma_m) {
  const float sigmas =
      std::min(distance_m / static_cast<float>(sigma_m), static_cast<float>(kReachSigmas));
  return 0.5F * sigmas * sigmas;
}

bool is_share(double value) { return value >= 0.0 && value <= 1.0; }

}  // namespace

Status validate(const FieldModelConfig& config, int map_classes) {
  const auto refuse = [](const char* field, std::string message) {
    return fail(Error{ErrorCode::kInvalidArgument, std::move(message), field});
  };
  if (!is_share(config.z_sdf) || !is_share(config.z_sem) ||
      std::abs(config.z_sdf + config.z_sem - 1.0) > 1e-9) {
    return refuse("z_sdf",
                  fmt::format("weights {} of sdf and {} of sem: expected two of [0, 1] with sum 1",
                              config.z_sdf,
                              config.z_sem));
  }
  for (const auto& [field, sigma_m] :
       {std::pair{"sigma_sdf", config.sigma_sdf_m}, std::pair{"sigma_sem", config.sigma_sem_m}}) {
    if (!(sigma_m >= 0.01 && sigma_m <= 100.0)) {
      return refuse(field, fmt::format("{} of {} m: expected 0.01 to 100", field, sigma_m));
    }
  }
  if (!config.movable.empty() && std::cmp_not_equal(config.movable.size(), map_classes)) {
    return refuse("movable",
                  fmt::format("{} values for the map's {} classes: expected one a class",
                              config.movable.size(),
                              map_classes));
  }
  if (!std::ranges::all_of(config.movable, is_share)) {
    return refuse("movable", "a class is movable by less than 0 or more than 1");
  }
  if (config.effective_pixels &&
      !(*config.effective_pixels > 0.0 && std::isfinite(*config.effective_pixels))) {
    return refuse(
        "effective_pixels",
        fmt::format("{} effective pixels: expected more than 0", *config.effective_pixels));
  }
  return {};
}

CueWeights cue_weights(const FieldModelConfig& config, ClassId map_label) {
  if (config.cue == FieldCue::kSdf || map_label == kUnknown) return {1.0, 0.0};
  if (config.cue == FieldCue::kSem) return {0.0, 1.0};
  if (config.movable.empty() || map_label == kNoHit) return {config.z_sdf, config.z_sem};
  const double alpha = config.movable[static_cast<std::size_t>(map_label) - 1];
  return {1.0 - alpha, alpha};
}

float pixel_loss(const FieldModelConfig& config,
                 const CueWeights& weights,
                 float sdf_m,
                 float class_distance_m) {
  // One cue alone needs neither the exponential nor its logarithm.
  if (weights.z_sem == 0.0) return exponent(sdf_m, config.sigma_sdf_m);
  if (weights.z_sdf == 0.0) return exponent(class_distance_m, config.sigma_sem_m);
  const float p_sdf = std::exp(-exponent(sdf_m, config.sigma_sdf_m));
  const float p_sem = std::exp(-exponent(class_distance_m, config.sigma_sem_m));
  const float p =
      static_cast<float>(weights.z_sdf) * p_sdf + static_cast<float>(weights.z_sem) * p_sem;
  return std::max(-std::log(p), 0.0F);
}

}  // namespace semview::field
