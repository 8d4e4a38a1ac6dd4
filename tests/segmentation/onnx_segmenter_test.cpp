// SPDX-License-Identifier: Apache-2.0
#include "semview/segmentation/onnx_segmenter.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "segmentation/colour_network.hpp"
#include "semview/core/random.hpp"
#include "support/paths.hpp"

namespace semview::segmentation {
namespace {

using semview::testing::onnx_convolution;
using semview::testing::TemporaryFolder;
using testing::colour_of_channel;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::write_colour_network;

std::vector<std::string> names(int count) {
  std::vector<std::string> result;
  for (int i = 0; i < count; ++i) result.push_back(fmt::format("class {}", i));
  return result;
}

/// Blocks of 4 x 4 pixels, each of the colour of some channel.
RgbImage blocks(int rows, int columns, int channels, Image<int>& truth) {
  RgbImage image(rows, columns);
  truth = Image<int>(rows, columns);
  Rng rng(7);
  Image<int> block(rows / 4 + 1, columns / 4 + 1);
  for (int& channel : block.pixels()) {
    channel = static_cast<int>(rng.below(static_cast<std::uint64_t>(channels)));
  }
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      truth.at(r, c) = block.at(r / 4, c / 4);
      image.at(r, c) = colour_of_channel(truth.at(r, c));
    }
  }
  return image;
}

TEST(OnnxSegmenterTest, AHundredAndFiftyChannelsLabelEveryPixel) {
  const TemporaryFolder folder;
  const auto file = write_colour_network(folder, names(150), 64, 200.0);
  const auto segmenter = OnnxSegmenter::load(file);
  ASSERT_TRUE(segmenter) << segmenter.error().message;
  EXPECT_EQ((*segmenter)->classes().size(), 150);
  Image<int> truth;
  const RgbImage image = blocks(64, 64, 150, truth);
  const Result<Segmentation> seen = (*segmenter)->segment(image);
  ASSERT_TRUE(seen) << seen.error().message;
  for (int r = 0; r < 64; ++r) {
    for (int c = 0; c < 64; ++c) ASSERT_EQ(seen->labels.at(r, c), truth.at(r, c) + 1);
  }
}

TEST(OnnxSegmenterTest, ConfidenceIsTheSoftmaxOfTheLogits) {
  const TemporaryFolder folder;
  const auto segmenter = OnnxSegmenter::load(write_colour_network(folder, names(3), 8, 2.0));
  ASSERT_TRUE(segmenter) << segmenter.error().message;
  const Rgb grey{90, 20, 0};
  const Result<Segmentation> seen = (*segmenter)->segment(RgbImage(8, 8, grey));
  ASSERT_TRUE(seen);
  double sum = 0.0;
  double best = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Rgb colour = colour_of_channel(k);
    const double dr = (grey.r - colour.r) / 255.0;
    const double dg = (grey.g - colour.g) / 255.0;
    const double db = (grey.b - colour.b) / 255.0;
    const double term = std::exp(-2.0 * (dr * dr + dg * dg + db * db));
    sum += term;
    best = std::max(best, term);
  }
  EXPECT_NEAR(seen->confidence.at(3, 3), 255.0 * best / sum, 1.0);
  EXPECT_EQ(seen->labels.at(3, 3), 3);
}

TEST(OnnxSegmenterTest, APictureOfAnotherSizeIsLabelledInItsOwn) {
  const TemporaryFolder folder;
  const auto segmenter = OnnxSegmenter::load(write_colour_network(folder, names(4), 32));
  ASSERT_TRUE(segmenter) << segmenter.error().message;
  RgbImage halves(90, 160, colour_of_channel(1));
  for (int r = 0; r < 90; ++r) {
    for (int c = 80; c < 160; ++c) halves.at(r, c) = colour_of_channel(2);
  }
  const Result<Segmentation> seen = (*segmenter)->segment(halves);
  ASSERT_TRUE(seen) << seen.error().message;
  ASSERT_EQ(seen->labels.rows(), 90);
  ASSERT_EQ(seen->labels.columns(), 160);
  for (int c = 0; c < 160; ++c) {
    if (std::abs(c - 80) <= 4) continue;
    EXPECT_EQ(seen->labels.at(45, c), c < 80 ? 2 : 3) << c;
  }
}

TEST(OnnxSegmenterTest, ChannelsListedAsUnknownAreNoClass) {
  const TemporaryFolder folder;
  const auto file = write_colour_network(folder, {"other", "wall", "floor"}, 8);
  folder.write("model/model.yaml", semview::testing::file_bytes(file) + "unknown: [other]\n");
  const auto segmenter = OnnxSegmenter::load(file);
  ASSERT_TRUE(segmenter) << segmenter.error().message;
  EXPECT_EQ((*segmenter)->classes(), ClassTable({"wall", "floor"}));
  EXPECT_EQ((*segmenter)->segment(RgbImage(4, 4, colour_of_channel(0)))->labels.at(1, 1), kUnknown);
  EXPECT_EQ((*segmenter)->segment(RgbImage(4, 4, colour_of_channel(2)))->labels.at(1, 1), 2);
}

/// The complaint about a network whose file is `bytes`, in one line.
std::string load_error(const std::string& bytes, const std::string& output = "logits") {
  const TemporaryFolder folder;
  const auto file = write_colour_network(folder, {"a", "b"}, 8);
  folder.write("model/network.onnx", bytes);
  std::string yaml = semview::testing::file_bytes(file);
  yaml.replace(yaml.find("logits"), 6, output);
  folder.write("model/model.yaml", yaml);
  const auto segmenter = OnnxSegmenter::load(file);
  if (!segmenter) return segmenter.error().message;
  const auto seen = (*segmenter)->segment(RgbImage(8, 8, Rgb{255, 255, 255}));
  return seen ? "no error" : seen.error().message;
}

TEST(OnnxSegmenterTest, ANetworkThatIsNoneSaysSoInOneLine) {
  const std::vector<float> weights(6, 1.0F);
  const std::vector<float> bias(2, 0.0F);
  const std::string good = onnx_convolution(weights, bias, 8, 8);
  EXPECT_EQ(load_error(good), "no error");
  for (const std::string& bad : {std::string("not a network"),
                                 std::string(),
                                 good.substr(0, good.size() / 2),
                                 onnx_convolution(weights, bias, 8, 8, "Hologram")}) {
    const std::string message = load_error(bad);
    EXPECT_THAT(message, HasSubstr("network.onnx: OpenCV cannot read the network: "));
    EXPECT_THAT(message, Not(HasSubstr("\n")));
  }
  EXPECT_THAT(load_error(onnx_convolution(weights, bias, 8, 8, "Hologram")), HasSubstr("Hologram"));
}

TEST(OnnxSegmenterTest, AnOutputThatDoesNotMatchTheClassListSaysSo) {
  const std::vector<float> bias(5, 0.0F);
  EXPECT_THAT(load_error(onnx_convolution(std::vector<float>(15, 1.0F), bias, 8, 8)),
              HasSubstr("the output has 5 channels, model.yaml lists 2 classes"));
  EXPECT_THAT(load_error(onnx_convolution(std::vector<float>(15, 1.0F), bias, 8, 8), "labels"),
              HasSubstr("the output has 5 channels, expected 1 of labels"));
}

TEST(OnnxSegmenterTest, NumbersThatAreNoneAreAnError) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(load_error(onnx_convolution(
                  std::vector<float>(6, 1.0F), std::vector<float>{0.0F, nan}, 8, 8)),
              HasSubstr("expected finite numbers"));
}

TEST(OnnxSegmenterTest, LogitsAreNoProbabilities) {
  const auto network = [](float bias) {
    return onnx_convolution(std::vector<float>(6, 0.0F), std::vector<float>{0.25F, bias}, 8, 8);
  };
  EXPECT_EQ(load_error(network(0.75F), "probabilities"), "no error");
  for (const float logit : {-0.5F, 7.0F}) {
    EXPECT_THAT(load_error(network(logit), "probabilities"),
                HasSubstr("expected probabilities from 0 to 1; is it `output: logits`?"));
    EXPECT_EQ(load_error(network(logit)), "no error");
  }
}

TEST(OnnxSegmenterTest, LabelsAreTakenAsTheyAre) {
  const std::vector<float> weights{1.0F / 255.0F, 0.0F, 0.0F};
  const auto network = [&](float bias) {
    return onnx_convolution(weights, std::vector<float>{bias}, 8, 8);
  };
  // A white pixel has the input 1, scaled once more by the weights to 1/255.
  EXPECT_EQ(load_error(network(-1.0F / 255.0F), "labels"), "no error");
  EXPECT_THAT(load_error(network(7.0F), "labels"), HasSubstr("expected a label from 0 to 1"));
}

TEST(OnnxSegmenterTest, TheShippedNetworkSeesAWall) {
  const auto segmenter = OnnxSegmenter::load(SEMVIEW_SOURCE_DIR "/models/deeplab_ade20k32");
  ASSERT_TRUE(segmenter) << segmenter.error().message;
  EXPECT_EQ((*segmenter)->classes().size(), 31);
  EXPECT_EQ((*segmenter)->classes().id("wall"), ClassId{1});
}

}  // namespace
}  // namespace semview::segmentation
