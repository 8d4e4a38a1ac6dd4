// SPDX-License-Identifier: Apache-2.0
#include "semview/segmentation/segmentation_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "semview/io/yaml_document.hpp"

namespace semview::segmentation {
namespace {

using io::YamlNode;

constexpr int kFormat = 1;
constexpr std::string_view kFile = "model.yaml";
constexpr double kSmallestScale = 1e-6;
constexpr double kLargestScale = 1e3;

/// A sequence of three numbers, or one that stands for all of them.
Result<std::array<double, 3>> three_numbers(const YamlNode& owner,
                                            std::string_view key,
                                            double otherwise) {
  const std::optional<YamlNode> node = owner.find(key);
  if (!node) return std::array<double, 3>{otherwise, otherwise, otherwise};
  if (node->is_scalar()) {
    SEMVIEW_TRY(const double number, node->number());
    return std::array<double, 3>{number, number, number};
  }
  SEMVIEW_TRY(const std::vector<double> numbers, node->numbers(3));
  return std::array<double, 3>{numbers[0], numbers[1], numbers[2]};
}

Result<int> side_px(const YamlNode& owner, std::string_view key) {
  SEMVIEW_TRY(const YamlNode node, owner.at(key));
  SEMVIEW_TRY(const std::int64_t pixels, node.integer());
  if (pixels < 1 || pixels > kMaxNetworkSide_px) {
    return node.error(fmt::format("{} {}, expected 1 to {}", key, pixels, kMaxNetworkSide_px));
  }
  return static_cast<int>(pixels);
}

/// What a pixel's value from 0 to 255 is multiplied by: of the size of 1 / 255 or of 1.
Result<std::array<double, 3>> scale_of(const YamlNode& input) {
  SEMVIEW_TRY(const auto scale, three_numbers(input, "scale", 1.0));
  for (const double factor : scale) {
    if (std::abs(factor) >= kSmallestScale && std::abs(factor) <= kLargestScale) continue;
    return input.at("scale")->error(
        fmt::format("scale {:g}, expected {:g} to {:g}; 1/255 = 0.00392 "
                    "makes values from 0 to 1",
                    factor,
                    kSmallestScale,
                    kLargestScale));
  }
  return scale;
}

Status read_input(const YamlNode& input, SegmentationModel& model) {
  SEMVIEW_TRY_STATUS(input.expect_keys({"width", "height", "channels", "mean", "scale"}));
  SEMVIEW_TRY(model.input_columns, side_px(input, "width"));
  SEMVIEW_TRY(model.input_rows, side_px(input, "height"));
  SEMVIEW_TRY(const std::string channels, input.text_or("channels", "rgb"));
  if (channels != "rgb" && channels != "bgr") {
    return input.at("channels")->error(fmt::format("channels '{}', expected rgb or bgr", channels));
  }
  model.bgr = channels == "bgr";
  SEMVIEW_TRY(model.mean, three_numbers(input, "mean", 0.0));
  SEMVIEW_TRY(model.scale, scale_of(input));
  return {};
}

Status read_output(const YamlNode& document, SegmentationModel& model) {
  SEMVIEW_TRY(const YamlNode node, document.at("output"));
  SEMVIEW_TRY(const std::string kind, node.text());
  constexpr std::array<std::pair<std::string_view, NetworkOutput>, 3> kKinds{
      {{"logits", NetworkOutput::kLogits},
       {"probabilities", NetworkOutput::kProbabilities},
       {"labels", NetworkOutput::kLabels}}};
  const auto* const known = std::ranges::find(kKinds, kind, &decltype(kKinds)::value_type::first);
  if (known == kKinds.end()) {
    return node.error(fmt::format("output '{}', expected logits, probabilities or labels", kind));
  }
  model.output = known->second;
  SEMVIEW_TRY(model.output_name, document.text_or("output_name", ""));
  return {};
}

Status read_classes(const YamlNode& document, SegmentationModel& model) {
  SEMVIEW_TRY(const YamlNode list, document.at("classes"));
  SEMVIEW_TRY(model.channels, list.texts());
  if (model.channels.empty() || model.channels.size() > kMaxClasses) {
    return list.error(
        fmt::format("{} classes, expected 1 to {}", model.channels.size(), kMaxClasses));
  }
  for (const YamlNode& item : list.items()) {
    SEMVIEW_TRY(const std::string name, item.text());
    if (name.empty()) return item.error("a class without a name");
    if (std::ranges::count(model.channels, name) > 1) {
      return item.error(fmt::format("class '{}' twice", name));
    }
  }
  std::vector<std::string> unknown;
  if (const std::optional<YamlNode> node = document.find("unknown")) {
    SEMVIEW_TRY(unknown, node->texts());
    for (const YamlNode& item : node->items()) {
      SEMVIEW_TRY(const std::string name, item.text());
      if (std::ranges::count(model.channels, name) == 0) {
        return item.error(fmt::format("'{}' is none of the classes", name));
      }
    }
  }
  ClassId next = 1;
  for (const std::string& name : model.channels) {
    const bool is_class = std::ranges::count(unknown, name) == 0;
    model.class_of_channel.push_back(is_class ? next++ : kUnknown);
  }
  if (next == 1) return list.error("every class is listed as unknown");
  return {};
}

}  // namespace

ClassTable SegmentationModel::classes() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (class_of_channel[i] != kUnknown) names.push_back(channels[i]);
  }
  return ClassTable(std::move(names));
}

Result<SegmentationModel> read_segmentation_model(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::path file =
      std::filesystem::is_directory(path, ignored) ? path / kFile : path;
  SEMVIEW_TRY(const YamlNode document, io::read_yaml(file));
  SEMVIEW_TRY_STATUS(document.expect_keys(
      {"format", "name", "network", "input", "output", "output_name", "classes", "unknown"}));
  SEMVIEW_TRY(const YamlNode format_node, document.at("format"));
  SEMVIEW_TRY(const std::int64_t format, format_node.integer());
  if (format != kFormat) {
    return fail(
        ErrorCode::kUnimplemented,
        fmt::format("{}: format {}, this version reads {}", format_node.where(), format, kFormat));
  }
  SegmentationModel model;
  SEMVIEW_TRY(model.name, document.text_or("name", file.parent_path().filename().string()));
  SEMVIEW_TRY(const YamlNode network, document.at("network"));
  SEMVIEW_TRY(const std::string network_name, network.text());
  model.network = file.parent_path() / network_name;
  if (!std::filesystem::is_regular_file(model.network, ignored)) {
    return network.error(fmt::format("network {} is no file", model.network.string()));
  }
  SEMVIEW_TRY(const YamlNode input, document.at("input"));
  SEMVIEW_TRY_STATUS(read_input(input, model));
  SEMVIEW_TRY_STATUS(read_output(document, model));
  SEMVIEW_TRY_STATUS(read_classes(document, model));
  return model;
}

Result<std::filesystem::path> find_segmentation_model(const std::string& id_or_path,
                                                      const std::filesystem::path& models) {
  std::error_code ignored;
  const std::filesystem::path given(id_or_path);
  if (std::filesystem::is_regular_file(given, ignored)) return given;
  if (std::filesystem::is_regular_file(given / kFile, ignored)) return given / kFile;
  const bool is_name = given.filename() == given && !id_or_path.empty();
  if (is_name && std::filesystem::is_regular_file(models / given / kFile, ignored)) {
    return models / given / kFile;
  }
  std::vector<std::string> shipped;
  for (const auto& entry : std::filesystem::directory_iterator(models, ignored)) {
    if (std::filesystem::exists(entry.path() / kFile, ignored)) {
      shipped.push_back(entry.path().filename().string());
    }
  }
  std::ranges::sort(shipped);
  return fail(Error{ErrorCode::kNotFound,
                    fmt::format("{}: no such model, expected a folder with {}, or the name of one "
                                "in {}",
                                id_or_path,
                                kFile,
                                models.string()),
                    {},
                    shipped.empty() ? fmt::format("{} holds none", models.string())
                                    : fmt::format("there: {}", fmt::join(shipped, ", "))});
}

}  // namespace semview::segmentation
