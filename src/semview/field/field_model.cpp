// SPDX-License-Identifier: Apache-2.0
#include "semview/field/field_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace semview::field {
namespace {

/// Differences from which on log(1 + e^-x) is less than half a unit, rounded up.
constexpr int kTableEnd_units = 10 * kUnitsPerNat;

/// log(1 + e^-x) in units, x in units.
const std::vector<std::uint16_t>& closeness_table() {
  static const std::vector<std::uint16_t> table = [] {
    std::vector<std::uint16_t> made(kTableEnd_units);
    for (int x = 0; x < kTableEnd_units; ++x) {
      const double nats = std::log1p(std::exp(-x / static_cast<double>(kUnitsPerNat)));
      made[static_cast<std::size_t>(x)] =
          static_cast<std::uint16_t>(std::lround(nats * kUnitsPerNat));
    }
    return made;
  }();
  return table;
}

float units_per_m2(double sigma_m) {
  return static_cast<float>(kUnitsPerNat / (2.0 * sigma_m * sigma_m));
}

/// -log z.
int units_of_weight(double z) {
  return z > 0.0 ? static_cast<int>(std::lround(-std::log(z) * kUnitsPerNat)) : 0;
}

int units_of_distance(float squared_m2, float units_per_m2) {
  return static_cast<int>(
      std::min(squared_m2 * units_per_m2 + 0.5F, static_cast<float>(kMaxLoss_units)));
}

/// -log(e^-a + e^-b), all in units.
int sum_of(int a, int b) {
  static const std::uint16_t* const closeness = closeness_table().data();
  const int apart = std::abs(a - b);
  return std::min(a, b) - (apart < kTableEnd_units ? closeness[apart] : 0);
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
  if (!(config.outlier >= 0.0 && config.outlier <= 0.99)) {
    return refuse("outlier",
                  fmt::format("a share of {} outliers: expected 0 to 0.99", config.outlier));
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

PixelLoss::PixelLoss(const FieldModelConfig& config, const CueWeights& weights)
    : weights_(weights),
      sdf_units_per_m2_(units_per_m2(config.sigma_sdf_m)),
      sem_units_per_m2_(units_per_m2(config.sigma_sem_m)),
      sdf_units_(units_of_weight(weights.z_sdf)),
      sem_units_(units_of_weight(weights.z_sem)),
      inlier_units_(units_of_weight(1.0 - config.outlier)),
      outlier_units_(units_of_weight(config.outlier)) {}

std::uint16_t PixelLoss::operator()(float sdf_m2, float class_m2) const {
  int loss = of_distances(sdf_m2, class_m2);
  if (outlier_units_ > 0) loss = sum_of(loss + inlier_units_, outlier_units_);
  return static_cast<std::uint16_t>(std::clamp(loss, 0, kMaxLoss_units));
}

int PixelLoss::of_distances(float sdf_m2, float class_m2) const {
  const int sdf = units_of_distance(sdf_m2, sdf_units_per_m2_);
  if (weights_.z_sem == 0.0) return sdf;
  const int sem = units_of_distance(class_m2, sem_units_per_m2_);
  if (weights_.z_sdf == 0.0) return sem;
  return sum_of(sdf + sdf_units_, sem + sem_units_);
}

}  // namespace semview::field
