// SPDX-License-Identifier: Apache-2.0
/// The observation model of the 2023 paper for one pixel.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/semantics/class_table.hpp"

namespace semview::field {

enum class FieldCue : std::uint8_t {
  kSdf,     ///< metric only: z_sdf = 1
  kSem,     ///< semantic only: z_sem = 1; pixels of unknown class are not counted
  kSdfSem,  ///< both
};

/// Defaults: section 4.1 of the paper.
struct FieldModelConfig {
  FieldCue cue = FieldCue::kSdfSem;
  double z_sdf = 0.5;        ///< z_sdf of equation (3), in [0, 1]; `kSdfSem` only
  double z_sem = 0.5;        ///< z_sem, 1 - z_sdf
  double sigma_sdf_m = 2.0;  ///< σ_sdf of equation (4), in [0.01, 100]
  double sigma_sem_m = 1.5;  ///< σ_sem of equation (5), in [0.01, 100]
  /// α of section 4.1, how changeable each class of the map is: z_sem = α, z_sdf = 1 - α. In the
  /// order of the map's classes; empty: z_sdf and z_sem for all. `kSdfSem` only.
  std::vector<double> movable = {};
  /// Share of pixels that show something the map does not know: (1 - outlier)·p + outlier in place
  /// of p, so that what was moved or renamed costs no more than -log outlier. In [0, 0.99]; 0: the
  /// paper's.
  double outlier = 0.0;
  /// The product over pixels is taken to this many pixels' worth, > 0: neighbouring pixels are not
  /// independent. None: to all pixels, equation (2), where one pose's weight is e^10000 times the
  /// next one's.
  std::optional<double> effective_pixels = 300.0;
};

/// @errors kInvalidArgument: out of range, or not one α a class; `Error::field` names it.
Status validate(const FieldModelConfig& config, int map_classes);

/// The weighting factors of equation (3).
struct CueWeights {
  double z_sdf = 0.0;
  double z_sem = 0.0;
};

/// Those of a pixel whose class is this one of the map; `kNoHit`: a class that the map does not
/// have; `kUnknown`: no class, p_sdf alone.
CueWeights cue_weights(const FieldModelConfig& config, ClassId map_label);

/// No distance counts as more than this many σ, so that no pixel, whatever happened to it, is less
/// likely than e^-8. So far is also a class that the map does not have or that is nowhere in reach.
///
/// What else the paper does not say: a point beyond the field's grid has the distances of the
/// nearest cell of it (a step there, of whatever height, would count for more than what the camera
/// sees); a voxel of a fused volume that was never observed has the truncation distance as sdf.
inline constexpr double kReachSigmas = 4.0;

/// Losses, -log p, are integers in units of 1 / kUnitsPerNat: the same on all machines, and no
/// order of summing matters.
inline constexpr int kUnitsPerNat = 8000;
/// kReachSigmas² / 2.
inline constexpr int kMaxLoss_units = 8 * kUnitsPerNat;

/// The loss of a pixel, equations (3) to (5), for one pair of weights.
///
/// Without exponential and logarithm: with a = sdf² / 2σ² - log z_sdf and b the same of sem, it is
/// min(a, b) - log(1 + e^-|a - b|), of which the last is a table (the first observation on a plan
/// of 40 × 25 m: 1.8 → 0.7 s).
class PixelLoss {
 public:
  PixelLoss(const FieldModelConfig& config, const CueWeights& weights);

  /// In [0, kMaxLoss_units], within 2 units of the formula; squared distances may be infinite.
  std::uint16_t operator()(float sdf_m2, float class_m2) const;

 private:
  int of_distances(float sdf_m2, float class_m2) const;

  CueWeights weights_;
  float sdf_units_per_m2_;
  float sem_units_per_m2_;
  int sdf_units_ = 0;  // -log z_sdf
  int sem_units_ = 0;
  int inlier_units_ = 0;   // -log(1 - outlier)
  int outlier_units_ = 0;  // -log outlier, 0 if there are none
};

}  // namespace semview::field
