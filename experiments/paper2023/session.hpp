// SPDX-License-Identifier: Apache-2.0
/// What a flat looks like another day.
#pragma once

#include <cstdint>

#include "flat.hpp"

namespace semview::paper2023 {

/// Shares of the things of the flat as it was mapped; no thing undergoes two changes.
struct ChangeConfig {
  double removed = 0.08;
  double moved = 0.08;
  double added = 0.08;
  double renamed = 0.03;  ///< that look like another class
  double min_move_m = 0.3;
  double max_move_m = 1.2;
};

/// The flat with whole numbers of things changed, to the nearest of each share; fewer moved or
/// added where there is no room. Added things have ids above all others.
Flat change(const Flat& flat, const ChangeConfig& config, std::uint64_t seed);

}  // namespace semview::paper2023
