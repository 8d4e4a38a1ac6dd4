// SPDX-License-Identifier: Apache-2.0
/// Observations of a run log that holds camera images.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "photo_labels.hpp"
#include "semview/core/result.hpp"
#include "semview/io/run_log.hpp"
#include "semview/view/observation.hpp"

namespace semview::cli {

/// Labels the images of `log`, which must outlive it.
class LogImages {
 public:
  LogImages(const io::RunLog& log, PhotoLabeller labeller)
      : log_(log), labeller_(std::move(labeller)) {}

  const ClassTable& classes() const { return labeller_.segmenter->classes(); }

  /// What the cameras saw at a frame; none of a frame without an image.
  Result<std::optional<Observation>> observe(std::size_t frame,
                                             const PanoramaCamera& profile) const;

 private:
  const io::RunLog& log_;
  PhotoLabeller labeller_;
};

/// The images of `log`, labelled by the network `model`; none if that is empty.
/// @errors kInvalidArgument: a model is named for a log without images, or none for one that has
/// nothing else; those of the network and of the log's camera rig.
Result<std::optional<LogImages>> open_log_images(const io::RunLog& log, const std::string& model);

}  // namespace semview::cli
