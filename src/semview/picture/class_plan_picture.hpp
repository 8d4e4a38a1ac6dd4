// SPDX-License-Identifier: Apache-2.0
/// A floor plan in its classes' colours, with legend, metres along the edges and a scale bar.
#pragma once

#include <string>
#include <vector>

#include "semview/picture/plan.hpp"

namespace semview::picture {

struct PlanClass {
  Rgb colour;  ///< in the plan's image
  std::string name;
};

struct ClassPlanPicture {
  Plan plan;
  std::vector<PlanClass> classes;  ///< the legend lists those that occur, with their area
  std::string title = {};
  int width_px = 1200;
};

RgbImage draw_class_plan(const ClassPlanPicture& picture);

}  // namespace semview::picture
