// SPDX-License-Identifier: Apache-2.0
/// The matcher that everything else has to beat.
#pragma once

#include <optional>

#include "semview/core/result.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/service/site.hpp"
#include "semview/view/observation.hpp"

namespace semview::places {

/// The free cell and heading with most pixels of equal class: names that are equal, or synonyms in
/// full, count 1 and everything else 0. None if no cell has a view.
/// @errors those of `ScoreSource::set_observation`, `heat_map`.
Result<std::optional<Pose2>> naive_place(const service::Site& floor,
                                         const Observation& observation);

}  // namespace semview::places
