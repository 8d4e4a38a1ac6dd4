// SPDX-License-Identifier: Apache-2.0
/// Photographs of one moment, labelled as `semview observe` labels them.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/segmentation/camera_rig.hpp"
#include "semview/segmentation/segmenter.hpp"
#include "semview/view/observation.hpp"

namespace semview::cli {

/// A network, and what took the pictures that it is shown.
struct PhotoLabeller {
  segmentation::CameraRig rig;
  std::unique_ptr<segmentation::Segmenter> segmenter;
  bool whole_sphere = false;  ///< the rig is one level equirectangular photograph

  /// @param files  one a camera of the rig
  /// @errors those of `io::read_photo`, `check_whole_sphere` and `segmentation::observe`.
  Result<Observation> observe(const std::vector<std::filesystem::path>& files,
                              double stamp_s,
                              const PanoramaCamera& profile) const;
};

/// @param model  a shipped network's name, or a folder with model.yaml
/// @param camera  rig file; empty: one level equirectangular photograph
/// @errors those of networks and rigs.
Result<PhotoLabeller> open_photo_labeller(const std::string& model, const std::string& camera);

}  // namespace semview::cli
