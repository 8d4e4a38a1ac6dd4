// SPDX-License-Identifier: Apache-2.0
/// A heat map over the plan, with colour bar and scale bar.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "semview/geometry/image.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/picture/plan.hpp"

namespace semview::picture {

struct HeatPicture {
  /// Row 0 = lowest y (as in the `.npy`); NaN = no value, the plan shows through.
  Image<float> values;
  double step_m = 0.1;   ///< a cell's side
  double x_min_m = 0.0;  ///< lower-left corner of cell (0, 0), frame `map`
  double y_min_m = 0.0;
  std::string quantity = "similarity";
  std::optional<Plan> plan = {};
  std::optional<Pose2> truth = {};  ///< drawn as a ring with a tick along the heading
  std::optional<Pose2> best = {};   ///< drawn as a cross
  std::string title = {};
  int width_px = 1200;
};

RgbImage draw_heat_map(const HeatPicture& picture);

}  // namespace semview::picture
