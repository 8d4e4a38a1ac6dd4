// SPDX-License-Identifier: Apache-2.0
/// Any ONNX network as a segmenter, by OpenCV's dnn module.
#pragma once

#include <filesystem>
#include <memory>

#include "semview/segmentation/segmentation_model.hpp"
#include "semview/segmentation/segmenter.hpp"

namespace semview::segmentation {

/// The picture is brought to the network's input size (squeezed where the shapes differ), the
/// network runs once, and its output is enlarged bilinearly to the picture before the best class of
/// each pixel is taken. docs/segmentation.md says which networks OpenCV 4.6 takes.
class OnnxSegmenter final : public Segmenter {
 public:
  /// Loads a network by its description; `model_yaml` may be the folder that holds it.
  /// @errors those of `read_segmentation_model`; kInvalidArgument: OpenCV cannot read the network,
  /// or its output has not one channel a class. One line each.
  /// @cost Reading the weights; the network is not run.
  static Result<std::unique_ptr<OnnxSegmenter>> load(const std::filesystem::path& model_yaml);

  ~OnnxSegmenter() override;

  const ClassTable& classes() const override;
  /// @errors kInvalidArgument: the picture is empty; kFailedPrecondition: the output holds a number
  /// that is not finite, or a label that is none; kInternal: the network failed.
  Result<Segmentation> segment(const RgbImage& image) override;

  const SegmentationModel& model() const;

 private:
  struct Parts;
  explicit OnnxSegmenter(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace semview::segmentation
