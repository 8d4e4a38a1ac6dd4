// SPDX-License-Identifier: Apache-2.0
/// Global localization on one recording, with one method, several times.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "flat.hpp"
#include "methods.hpp"
#include "recording.hpp"
#include "semview/core/result.hpp"
#include "semview/field/distance_field.hpp"

namespace semview::paper2023 {

/// What the filter knew at one image, before it resampled.
struct StopRecord {
  double distance_m = 0.0;  ///< driven since the first image
  double position_m = 0.0;  ///< error of the weighted mean
  double heading_rad = 0.0;
  double effective_particles = 0.0;

  bool operator==(const StopRecord&) const = default;
};

/// `config` is that of the method (`configured`). One execution a seed: nothing is known of where
/// the robot is but the flat's outline.
/// @errors those of the likelihood
Result<std::vector<std::vector<StopRecord>>> run_trials(
    const Recording& recording,
    const Area& inside,
    const Method& method,
    const FilterConfig& config,
    std::shared_ptr<const field::DistanceField> map,
    const std::vector<std::uint64_t>& seeds);

}  // namespace semview::paper2023
