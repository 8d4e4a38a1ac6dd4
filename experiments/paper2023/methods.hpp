// SPDX-License-Identifier: Apache-2.0
/// The methods of the paper's tables, ours, and the setting of the filter.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "detections.hpp"
#include "semview/field/field_model.hpp"
#include "semview/localization/odometry_motion_model.hpp"

namespace semview::paper2023 {

/// What ours adds to the paper's sdf+sem.
enum class Idea {
  kOutliers,  ///< a fifth of the pixels may show what the map does not know
  kSigma,     ///< σ_sdf = σ_sem = 1 m
  kMotion,    ///< motion noise nearer to what the odometry errs
};

struct Method {
  std::string id;  ///< "sdf_sem_gt"
  field::FieldCue cue = field::FieldCue::kSdfSem;
  LabelSource labels = LabelSource::kGt;  ///< of the map and of what is observed
  std::vector<Idea> ideas = {};           ///< none: as printed
  std::string printed = id;               ///< whose printed figures stand beside its own
};

/// sdf, sem_gt, sem_rcnn, sdf_sem_gt, sdf_sem_rcnn as printed; ours_gt, ours_rcnn with all ideas;
/// and for the ablation both with one idea off, as ours_gt_no_outliers.
const std::vector<Method>& all_methods();

/// All but those of the ablation.
std::vector<Method> default_methods();

/// Null if there is none of that id.
const Method* find_method(std::string_view id);

/// What the paper prints of its filter, and what it does not.
struct FilterConfig {
  int particles = 3000;
  field::FieldModelConfig model;  ///< z and σ as printed; `cue` is the method's
  /// The product over pixels, equation (2), is taken to this power: neighbouring pixels are not
  /// independent. Of an image of 19 200 pixels 0.003 are 58.
  double temper = 0.003;
  localization::OdometryMotionConfig motion{0.1, 0.05, 0.1, 0.05};
  /// A filter has converged when the robot has come this far, as the paper reads off its Fig. 8.
  double converged_after_m = 1.75;
  /// A run whose mean error after that is larger has failed.
  double failed_above_m = 1.0;
};

/// That of a method: `config` with its cue and its ideas.
FilterConfig configured(const Method& method, FilterConfig config);

/// Every setting, a line each part.
std::string describe(const FilterConfig& config);

}  // namespace semview::paper2023
