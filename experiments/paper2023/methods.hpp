// SPDX-License-Identifier: Apache-2.0
/// The five columns of the paper's tables, and the one setting of its filter.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "detections.hpp"
#include "semview/field/field_model.hpp"
#include "semview/localization/odometry_motion_model.hpp"

namespace semview::paper2023 {

struct Method {
  std::string id;  ///< "sdf_sem_gt"
  field::FieldCue cue = field::FieldCue::kSdfSem;
  LabelSource labels = LabelSource::kGt;  ///< of the map and of what is observed
};

/// sdf, sem_gt, sem_rcnn, sdf_sem_gt, sdf_sem_rcnn.
const std::vector<Method>& all_methods();

/// Null if there is none of that id.
const Method* find_method(std::string_view id);

/// What the paper prints of its filter, and what it does not.
struct FilterConfig {
  int particles = 3000;
  field::FieldModelConfig model;  ///< z and σ as printed; `cue` is the method's
  /// The product over pixels, equation (2), is taken to this power: neighbouring pixels are not
  /// independent. Of an image of 19 200 pixels 0.02 are 384.
  double temper = 0.02;
  localization::OdometryMotionConfig motion{0.02, 0.01, 0.02, 0.005};
  /// A filter has converged when the robot has come this far, as the paper reads off its Fig. 8.
  double converged_after_m = 1.75;
  /// A run whose mean error after that is larger has failed.
  double failed_above_m = 1.0;
};

/// Every setting, a line each part.
std::string describe(const FilterConfig& config);

}  // namespace semview::paper2023
