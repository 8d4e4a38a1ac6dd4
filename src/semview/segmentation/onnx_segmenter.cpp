// SPDX-License-Identifier: Apache-2.0
#include "semview/segmentation/onnx_segmenter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include "semview/segmentation/upsampling.hpp"

namespace semview::segmentation {
namespace {

constexpr std::size_t kMaxReason_bytes = 300;

/// What an exception of OpenCV says, in one line and without its source files.
std::string reason_of(const std::exception& error) {
  const auto* from_opencv = dynamic_cast<const cv::Exception*>(&error);
  const std::string_view whole =
      from_opencv != nullptr ? std::string_view(from_opencv->err) : std::string_view(error.what());
  std::string line;
  for (const char c : whole) {
    // It begins the lines of an error within an error by '>'.
    const bool blank = c == '\n' || c == '\r' || c == '\t' || c == ' ' || c == '>';
    if (blank && (line.empty() || line.back() == ' ')) continue;
    line += blank ? ' ' : c;
  }
  if (line.size() > kMaxReason_bytes) line = line.substr(0, kMaxReason_bytes) + " ...";
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

tl::unexpected<Error> not_loaded(const SegmentationModel& model, const std::string& reason) {
  return fail(
      Error{ErrorCode::kInvalidArgument,
            fmt::format("{}: OpenCV cannot read the network: {}", model.network.string(), reason),
            {},
            "docs/segmentation.md says what OpenCV's importer refuses and how to export "
            "round it"});
}

std::string shape_text(std::span<const int> shape) {
  return fmt::format("{}", fmt::join(shape, " x "));
}

/// The rows and columns of an output of the right shape: 1 x channels x rows x columns, of labels
/// also 1 x rows x columns.
Result<std::pair<int, int>> output_size(const SegmentationModel& model,
                                        std::span<const int> shape) {
  const bool labels = model.output == NetworkOutput::kLabels;
  const int wanted = labels ? 1 : static_cast<int>(model.channels.size());
  const bool flat = labels && shape.size() == 3 && shape[0] == 1;
  if (!flat && (shape.size() != 4 || shape[0] != 1)) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: the output is {}, expected 1 x {} x rows x columns",
                            model.network.string(),
                            shape_text(shape),
                            wanted));
  }
  if (!flat && shape[1] != wanted) {
    return fail(ErrorCode::kInvalidArgument,
                labels ? fmt::format("{}: the output has {} channels, expected 1 of labels; is it "
                                     "`output: logits`?",
                                     model.network.string(),
                                     shape[1])
                       : fmt::format("{}: the output has {} channels, model.yaml lists {} classes",
                                     model.network.string(),
                                     shape[1],
                                     wanted));
  }
  const int rows = shape[shape.size() - 2];
  const int columns = shape[shape.size() - 1];
  if (rows < 1 || columns < 1) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: the output is {}, which holds no pixel",
                            model.network.string(),
                            shape_text(shape)));
  }
  return std::pair{rows, columns};
}

/// Each pixel of the picture takes the label of the output's pixel at the same place.
Result<Segmentation> nearest_labels(const SegmentationModel& model,
                                    std::span<const float> values,
                                    std::pair<int, int> size,
                                    const RgbImage& image) {
  const auto [rows, columns] = size;
  Segmentation result{LabelImage(image.rows(), image.columns()),
                      Image<std::uint8_t>(image.rows(), image.columns(), 255)};
  for (int r = 0; r < image.rows(); ++r) {
    const auto source_row = static_cast<std::int64_t>(r) * rows / image.rows();
    for (int c = 0; c < image.columns(); ++c) {
      const auto source_column = static_cast<std::int64_t>(c) * columns / image.columns();
      const float value = values[static_cast<std::size_t>(source_row * columns + source_column)];
      const auto count = static_cast<float>(model.channels.size());
      if (!(value >= 0.0F && value < count) || value != std::floor(value)) {
        return fail(ErrorCode::kFailedPrecondition,
                    fmt::format("{}: the output at row {}, column {} is {:g}, expected a label "
                                "from 0 to {}",
                                model.network.string(),
                                source_row,
                                source_column,
                                value,
                                model.channels.size() - 1));
      }
      const ClassId id = model.class_of_channel[static_cast<std::size_t>(value)];
      result.labels.at(r, c) = id;
    }
  }
  return result;
}

/// Logits called probabilities would make labels of any confidence.
Status check_probabilities(const SegmentationModel& model, std::span<const float> values) {
  constexpr float kRounding = 1e-3F;
  const auto bad = std::ranges::find_if(
      values, [](float value) { return value < -kRounding || value > 1.0F + kRounding; });
  if (bad == values.end()) return {};
  return fail(ErrorCode::kFailedPrecondition,
              fmt::format("{}: the output holds {:g}, expected probabilities from 0 to 1; is it "
                          "`output: logits`?",
                          model.network.string(),
                          *bad));
}

}  // namespace

struct OnnxSegmenter::Parts {
  SegmentationModel model;
  ClassTable classes;
  cv::dnn::Net net;
  std::string output;

  Status choose_output();
  Status check_shapes() const;
  cv::Mat blob_of(const RgbImage& image) const;
};

Status OnnxSegmenter::Parts::choose_output() {
  const std::vector<std::string> names = net.getUnconnectedOutLayersNames();
  if (!model.output_name.empty()) {
    output = model.output_name;
    if (net.getLayerId(output) >= 0) return {};
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: has no output {}, expected one of: {}",
                            model.network.string(),
                            output,
                            fmt::join(names, ", ")));
  }
  if (names.size() != 1) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: has {} outputs ({}); name one as output_name in model.yaml",
                            model.network.string(),
                            names.size(),
                            fmt::join(names, ", ")));
  }
  output = names.front();
  return {};
}

Status OnnxSegmenter::Parts::check_shapes() const {
  std::vector<int> layers;
  std::vector<std::vector<cv::dnn::MatShape>> inputs;
  std::vector<std::vector<cv::dnn::MatShape>> outputs;
  const cv::dnn::MatShape input{1, 3, model.input_rows, model.input_columns};
  try {
    net.getLayersShapes(input, layers, inputs, outputs);
  } catch (const std::exception& error) {
    return fail(
        ErrorCode::kInvalidArgument,
        fmt::format("{}: takes no pictures of width {} and height {} (input of model.yaml), "
                    "expected the size that the network was made for: {}",
                    model.network.string(),
                    model.input_columns,
                    model.input_rows,
                    reason_of(error)));
  }
  const int wanted = cv::dnn::Net(net).getLayerId(output);
  const auto at = std::ranges::find(layers, wanted);
  if (at == layers.end()) return {};  // then the first picture tells
  const auto& shapes = outputs[static_cast<std::size_t>(at - layers.begin())];
  if (shapes.empty()) return {};
  SEMVIEW_TRY_STATUS(output_size(model, shapes.front()));
  return {};
}

cv::Mat OnnxSegmenter::Parts::blob_of(const RgbImage& image) const {
  static_assert(sizeof(Rgb) == 3);
  // OpenCV has no constant view of pixels; it is only read from.
  const cv::Mat whole(
      image.rows(), image.columns(), CV_8UC3, const_cast<Rgb*>(image.pixels().data()));
  const bool shrinks = model.input_rows < image.rows() || model.input_columns < image.columns();
  cv::Mat picture;
  cv::resize(whole,
             picture,
             {model.input_columns, model.input_rows},
             0.0,
             0.0,
             shrinks ? cv::INTER_AREA : cv::INTER_LINEAR);
  const std::array<int, 4> shape{1, 3, model.input_rows, model.input_columns};
  cv::Mat blob(static_cast<int>(shape.size()), shape.data(), CV_32F);
  for (int k = 0; k < 3; ++k) {
    const int source_channel = model.bgr ? 2 - k : k;
    const double mean = model.mean[static_cast<std::size_t>(k)];
    const double scale = model.scale[static_cast<std::size_t>(k)];
    auto* value = blob.ptr<float>(0, k);
    for (int r = 0; r < picture.rows; ++r) {
      const unsigned char* row = picture.ptr<unsigned char>(r);
      for (int c = 0; c < picture.cols; ++c) {
        *value++ = static_cast<float>((row[3 * c + source_channel] - mean) * scale);
      }
    }
  }
  return blob;
}

OnnxSegmenter::OnnxSegmenter(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
OnnxSegmenter::~OnnxSegmenter() = default;

const ClassTable& OnnxSegmenter::classes() const { return parts_->classes; }
const SegmentationModel& OnnxSegmenter::model() const { return parts_->model; }

Result<std::unique_ptr<OnnxSegmenter>> OnnxSegmenter::load(
    const std::filesystem::path& model_yaml) {
  auto parts = std::make_unique<Parts>();
  SEMVIEW_TRY(parts->model, read_segmentation_model(model_yaml));
  parts->classes = parts->model.classes();
  // What it writes before it throws is in the exception, too.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  try {
    parts->net = cv::dnn::readNetFromONNX(parts->model.network.string());
    if (parts->net.empty()) return not_loaded(parts->model, "it holds no layer");
    parts->net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    parts->net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
    SEMVIEW_TRY_STATUS(parts->choose_output());
    SEMVIEW_TRY_STATUS(parts->check_shapes());
  } catch (const std::exception& error) {
    return not_loaded(parts->model, reason_of(error));
  }
  return std::unique_ptr<OnnxSegmenter>(new OnnxSegmenter(std::move(parts)));
}

Result<Segmentation> OnnxSegmenter::segment(const RgbImage& image) {
  if (image.empty()) return fail(ErrorCode::kInvalidArgument, "an empty picture");
  const SegmentationModel& model = parts_->model;
  cv::Mat output;
  try {
    parts_->net.setInput(parts_->blob_of(image));
    output = parts_->net.forward(parts_->output);
    if (output.depth() != CV_32F) output.convertTo(output, CV_32F);
  } catch (const std::exception& error) {
    return fail(
        ErrorCode::kInternal,
        fmt::format("{}: the network failed: {}", model.network.string(), reason_of(error)));
  }
  const std::span<const int> shape(output.size.p, static_cast<std::size_t>(output.dims));
  SEMVIEW_TRY(const auto size, output_size(model, shape));
  const std::span<const float> values(output.ptr<float>(), output.total());
  if (model.output == NetworkOutput::kLabels) return nearest_labels(model, values, size, image);
  const auto bad = std::ranges::find_if_not(values, [](float v) { return std::isfinite(v); });
  if (bad != values.end()) {
    return fail(
        ErrorCode::kFailedPrecondition,
        fmt::format(
            "{}: the output holds {:g}, expected finite numbers", model.network.string(), *bad));
  }
  if (model.output == NetworkOutput::kProbabilities) {
    SEMVIEW_TRY_STATUS(check_probabilities(model, values));
  }
  const ChannelPlanes planes{
      values, static_cast<int>(model.channels.size()), size.first, size.second};
  return best_classes(planes, model, image.rows(), image.columns());
}

}  // namespace semview::segmentation
