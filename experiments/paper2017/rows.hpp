// SPDX-License-Identifier: Apache-2.0
/// The eighteen rows of the paper's Fig. 3: what is done to the map, the view or the classes.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "plan_drawing.hpp"
#include "semview/core/result.hpp"
#include "semview/geometry/affine.hpp"
#include "semview/geometry/angle.hpp"

namespace semview::paper2017 {

/// What the paper printed for a row, mean distances over ten runs, m.
struct Printed {
  double identity_best_m = 0.0;
  double identity_min_m = 0.0;
  double weighted_best_m = 0.0;
  double weighted_min_m = 0.0;
  double odometry_m = 0.0;
};

/// What ours should reach: the ratio to the frozen baseline's error counts, the error itself is
/// second, since the paper's building is not to be had.
struct Goal {
  double best_m = 0.0;
  double ratio = 0.0;
};

struct Row {
  std::string id;     ///< "scale_1.2"
  std::string title;  ///< "Scaling by 1.20 & 0.83"
  MapAffine affine = {};
  double field_of_view_rad = rad_from_deg(268.0);
  ClassSubset classes = ClassSubset::kAll;
  Printed printed = {};
  Goal goal = {};
};

/// In the order of Fig. 3. Scales stretch y and shrink x, as in Fig. 2; shears move y by x.
const std::vector<Row>& all_rows();

/// Null if there is none of that id.
const Row* find_row(std::string_view id);

/// None named: all. @errors kInvalidArgument, field `--rows`: an id that there is not.
Result<std::vector<Row>> rows_by_id(std::span<const std::string> ids);

}  // namespace semview::paper2017
