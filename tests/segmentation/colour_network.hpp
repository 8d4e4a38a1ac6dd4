// SPDX-License-Identifier: Apache-2.0
/// A network that tells colours apart, for tests: channel k wins where a pixel has colour k.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "semview/geometry/image.hpp"
#include "support/onnx_file.hpp"
#include "support/temporary_folder.hpp"

namespace semview::segmentation::testing {

/// Well-separated colours, one a class: a lattice of 6 x 6 x 6.
inline Rgb colour_of_channel(int channel) {
  const auto step = [](int k) { return static_cast<unsigned char>(51 * k); };
  return {step(channel % 6), step(channel / 6 % 6), step(channel / 36)};
}

/// Writes model.yaml and an ONNX file of one convolution whose channel k is largest for
/// `colour_of_channel(k)`: the logit is - |x - colour|² without its x² term, which all share, times
/// `sharpness`.
inline std::filesystem::path write_colour_network(const semview::testing::TemporaryFolder& folder,
                                                  const std::vector<std::string>& names,
                                                  int side_px = 64,
                                                  double sharpness = 20.0) {
  std::vector<float> weights;
  std::vector<float> bias;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const Rgb colour = colour_of_channel(static_cast<int>(k));
    double squared = 0.0;
    for (const unsigned char part : {colour.r, colour.g, colour.b}) {
      const double value = part / 255.0;
      weights.push_back(static_cast<float>(sharpness * 2.0 * value));
      squared += value * value;
    }
    bias.push_back(static_cast<float>(-sharpness * squared));
  }
  folder.write("model/network.onnx",
               semview::testing::onnx_convolution(weights, bias, side_px, side_px));
  std::string yaml = fmt::format(
      "format: 1\nnetwork: network.onnx\ninput: {{width: {0}, height: {0}, scale: "
      "0.00392156862745098}}\noutput: logits\nclasses:\n",
      side_px);
  for (const std::string& name : names) yaml += fmt::format("  - {}\n", name);
  return folder.write("model/model.yaml", yaml);
}

}  // namespace semview::segmentation::testing
