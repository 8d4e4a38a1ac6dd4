// SPDX-License-Identifier: Apache-2.0
/// Fills the rooms of a layout.
#pragma once

#include <cstdint>

#include "layout.hpp"

namespace semview::paper2017 {

/// Adds furniture and clutter to rooms whose walls, doors and windows are there.
void furnish(Layout& layout, const LayoutConfig& config, std::uint64_t seed);

}  // namespace semview::paper2017
