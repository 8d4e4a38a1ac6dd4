// SPDX-License-Identifier: Apache-2.0
/// Labels as a network gives them for photographs of rooms: much worse than for simulated cameras.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "semview/core/random.hpp"
#include "semview/simulation/segmentation_noise.hpp"
#include "semview/view/column_view.hpp"

namespace semview::simulation {

/// What becomes of one class of the building.
struct ClassFate {
  ClassId right = kUnknown;  ///< the network's class where it errs not
  double recall = 1.0;       ///< share of pixels that get it, on average
  /// The network's classes where it errs, and how often each, in any unit.
  std::vector<std::pair<ClassId, double>> instead;
};

struct PhotographConfig {
  double recall_spread = 0.1;  ///< σ of each class's recall between pictures
  /// Pictures on the whole: good ones keep the recall; of the others, most keep this share of it
  /// at least, and some hardly any.
  double fair_share = 0.35;  ///< of pictures; their recall is scaled by 0.4 to 0.95
  double poor_share = 0.05;  ///< of pictures; their recall is scaled by 0.1
  double tilt_rad = 0.01;    ///< σ of pitch and roll that were not undone
  double wave_rad = 0.5;     ///< size of the patches in which a network errs
  int patches = 90;          ///< each with a wrong class of its own
};

/// `truth` with ids of the network: tilted, borders swinging to and fro, and each class c right in
/// a random field's lower part, a share of about `fates[c].recall` of it; elsewhere patches of
/// `fates[c].instead`. Classes without a fate and rays that meet nothing become `nothing`.
/// @param fates  by id of the building's class; entry 0 is for rays that meet nothing
LabelImage photograph(const LabelImage& truth,
                      const LabelGeometry& geometry,
                      const std::vector<ClassFate>& fates,
                      const PhotographConfig& config,
                      Rng& rng);

/// The names that `photograph`s of buildings use, in the spelling of ADE20K.
std::vector<std::string> photograph_classes();

/// What a network makes of a building's class on real photographs: recall 0.87 for walls, 0.77 for
/// floors and ceilings, 0.71 for windows, 0.29 for doors.
/// @param class_names  of the building, in id order; @return one fate a class and one for nothing
std::vector<ClassFate> photograph_fates(const std::vector<std::string>& class_names);

}  // namespace semview::simulation
