// SPDX-License-Identifier: Apache-2.0
/// Systematic resampling.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "semview/core/random.hpp"

namespace semview::localization {

/// Draws `count` ancestors with one random number: ancestor i appears floor or ceil of
/// count · w_i / Σw times, and count · w_i / Σw times on average.
///
/// @param weights  >= 0 and finite, with a sum > 0
/// @return indices into `weights`, in rising order
/// @source Thrun, Burgard, Fox 2005, table 4.4 (low_variance_sampler).
std::vector<std::uint32_t> low_variance_sample(std::span<const double> weights,
                                               std::size_t count,
                                               Rng& rng);

}  // namespace semview::localization
