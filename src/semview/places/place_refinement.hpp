// SPDX-License-Identifier: Apache-2.0
/// From a cell and a heading of the grid to a pose between them.
#pragma once

#include <functional>
#include <optional>

#include "semview/geometry/pose2.hpp"
#include "semview/places/column_scorer.hpp"
#include "semview/view/column_view.hpp"

namespace semview::places {

/// What is seen from exactly (x, y) at this eye height, at yaw 0; none where no eye can be.
using ExactView =
    std::function<std::optional<LabelImage>(double x_m, double y_m, double eye_height_m)>;

struct RefinementConfig {
  double first_step_m = 0.06;     ///< of the search in x and y
  double last_step_m = 0.015;     ///< the step is halved until it is below this
  int most_moves = 8;             ///< a step size
  bool finds_eye_height = false;  ///< the eye height is searched too, with steps twice as large
  double height_reach_m = 0.2;    ///< as far from where the search began
};

struct EyePlacement {
  Pose2 map_from_eye;
  double eye_height_m = 0.0;
  double score = 0.0;  ///< of `ColumnScorer`; -∞ if there is no view
};

/// Climbs from `start` to a place from which every neighbour scores less: in x, y (and height) by
/// steps, in heading by whole columns and, at the end, by a parabola between them.
EyePlacement refine(const EyePlacement& start,
                    const ColumnScorer& scorer,
                    const ExactView& exact_view,
                    const RefinementConfig& config);

}  // namespace semview::places
