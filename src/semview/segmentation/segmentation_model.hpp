// SPDX-License-Identifier: Apache-2.0
/// The description of a network beside its file. See docs/formats/segmentation_model.md.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/semantics/class_table.hpp"

namespace semview::segmentation {

/// What a network gives for each pixel.
enum class NetworkOutput {
  kLogits,         ///< a number a class, the largest wins; probabilities by softmax
  kProbabilities,  ///< the same after a softmax
  kLabels,         ///< the channel's number itself
};

struct SegmentationModel {
  std::string name;               ///< one line for people
  std::filesystem::path network;  ///< ONNX file
  int input_columns = 0;
  int input_rows = 0;
  bool bgr = false;  ///< order of the colour channels; else RGB
  /// A channel's input is (value of 0..255 - mean) · scale; in the network's order.
  std::array<double, 3> mean = {0.0, 0.0, 0.0};
  std::array<double, 3> scale = {1.0, 1.0, 1.0};
  NetworkOutput output = NetworkOutput::kLogits;
  std::string output_name;                ///< of a network with several outputs; else may be empty
  std::vector<std::string> channels;      ///< class names in the order of the output's channels
  std::vector<ClassId> class_of_channel;  ///< `kUnknown` for those that stand for nothing

  /// The channels that are classes, in their order.
  ClassTable classes() const;
};

inline constexpr int kMaxNetworkSide_px = 4096;

/// Reads `model.yaml`; `path` may be the folder that holds it.
/// @errors kNotFound: no such file; kInvalidArgument with file and line; kUnimplemented: a format
/// of later versions.
Result<SegmentationModel> read_segmentation_model(const std::filesystem::path& path);

/// The model.yaml of a model given by file, by folder, or by its folder's name in `models`, where
/// shipped models are.
/// @errors kNotFound: none of them; the hint lists the shipped ones.
Result<std::filesystem::path> find_segmentation_model(const std::string& id_or_path,
                                                      const std::filesystem::path& models);

}  // namespace semview::segmentation
