// SPDX-License-Identifier: Apache-2.0
/// The options of `semview observe`.
#pragma once

#include <string>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/segmentation/camera_rig.hpp"
#include "semview/segmentation/onnx_segmenter.hpp"
#include "semview/segmentation/panorama_observer.hpp"

namespace CLI {
class App;
}

namespace semview::cli {

inline constexpr const char* kDefaultModel = "deeplab_ade20k32";

/// As given on the command line.
struct ObserveOptions {
  std::vector<std::string> images;
  std::string camera;  ///< rig file; empty with --equirectangular
  bool equirectangular = false;
  double eye_height_m = 1.2;
  std::string model = kDefaultModel;
  bool labels = false;  ///< the images are label images of another program
  std::string classes;  ///< the vocabulary of these
  int first_value = 1;  ///< pixel value of its first class
  std::string output;
  std::string overlay;
  double stamp_s = 0.0;
  segmentation::PanoramaObserverConfig panorama = {};
  bool json = false;
};

/// Declares the options; `options` must outlive the parse.
void add_observe_options(CLI::App& verb, ObserveOptions& options);

/// What belongs together.
/// @errors kInvalidArgument, with the option as the field.
Status check_observe_options(const ObserveOptions& options);

/// @errors those of `read_camera_rig`; kInvalidArgument: another number of images than cameras.
Result<segmentation::CameraRig> observe_rig(const ObserveOptions& options);

/// Whether a picture may be a photograph of the whole sphere: one of another shape would be
/// stretched over it, and nothing in the result would look wrong.
/// @errors kInvalidArgument: not twice as wide as high, within 2 %.
Status check_whole_sphere(const std::string& file, int columns, int rows);

/// The network of a model that is given by name or path, among those installed with this program.
Result<std::unique_ptr<segmentation::OnnxSegmenter>> open_segmenter(const std::string& model);

}  // namespace semview::cli
