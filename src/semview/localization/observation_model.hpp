// SPDX-License-Identifier: Apache-2.0
/// The seam between the filter and what tells good poses from bad ones.
#pragma once

#include <span>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/pose2.hpp"

namespace semview::localization {

/// How well each pose explains the current observation.
struct ObservationWeights {
  /// One a pose; a common offset means nothing. -∞: impossible.
  std::vector<double> log_weights;
  /// From a visual compass: one a pose, the heading that explains it best (NaN:
  /// no reading); else empty.
  std::vector<double> headings_rad;
};

/// Weighs a batch of poses against the observation that its owner has given it.
///
/// The weight of a pose depends on the pose and the observation alone, apart from rules about
/// poses that cannot be weighed, which may look at the batch. @threads for one thread at a time
class ObservationModel {
 public:
  virtual ~ObservationModel() = default;
  virtual Result<ObservationWeights> weigh(std::span<const Pose2> poses) = 0;
};

}  // namespace semview::localization
