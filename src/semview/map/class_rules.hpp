// SPDX-License-Identifier: Apache-2.0
/// The rules of a class list. Inside the module only.
#pragma once

#include "semview/map/column_builder.hpp"
#include "semview/map/map_file.hpp"
#include "semview/map/map_problem.hpp"

namespace semview::map::detail {

/// Adds to `report` what is wrong between the classes of `file`: names, colours, heights,
/// references; and warns of heights that ground or ceiling cut.
void check_classes(const MapFile& file, MapReport& report);

/// Warns of classes that nothing uses. `drawn[i]` says whether class i + 1 covers a pixel (or a
/// triangle).
void check_unused(const MapFile& file, const std::vector<bool>& drawn, MapReport& report);

/// Ground and ceiling with their classes as ids of `table`; unknown names are `kNoHit`.
Storey storey_of(const MapFile& file, const ClassTable& table);

}  // namespace semview::map::detail
