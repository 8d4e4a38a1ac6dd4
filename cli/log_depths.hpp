// SPDX-License-Identifier: Apache-2.0
/// Observations of a run log that holds depth images.
#pragma once

#include <cstddef>
#include <optional>

#include "model_options.hpp"
#include "semview/core/result.hpp"
#include "semview/io/run_log.hpp"
#include "semview/observation/voxel_reduction.hpp"
#include "semview/view/observation.hpp"

namespace semview::cli {

/// Reads depths and labels of `log`, which must outlive it.
class LogDepths {
 public:
  LogDepths(const io::RunLog& log, const ModelOptions& options)
      : log_(log),
        reduction_(options.reduction),
        needs_classes_(options.model == name(ScoreModel::kSem)),
        with_panorama_(is_mixed(options)) {}

  /// What the camera saw at a frame; none of a frame without all that the model looks at: a depth
  /// that can be used, for `sem` a class, and for `mixed` labels.
  /// @param profile  of the panorama that `mixed` compares, too
  /// @errors those of reading the images.
  Result<std::optional<Observation>> observe(std::size_t frame,
                                             const PanoramaCamera& profile) const;

 private:
  const io::RunLog& log_;
  observation::VoxelReductionConfig reduction_;
  bool needs_classes_;
  bool with_panorama_;
};

/// The depths of `log`; none where --model scores views.
/// @errors kInvalidArgument: no pinhole camera, or no frame with a depth.
Result<std::optional<LogDepths>> open_log_depths(const io::RunLog& log,
                                                 const ModelOptions& options);

}  // namespace semview::cli
