// SPDX-License-Identifier: Apache-2.0
#include "semview/segmentation/segmentation_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace semview::segmentation {
namespace {

using semview::testing::TemporaryFolder;
using ::testing::HasSubstr;

const std::string kHead = "format: 1\nnetwork: n.onnx\n";
const std::string kInput = "input: {width: 8, height: 4}\n";
const std::string kTail = "output: logits\nclasses: [a, b]\n";

std::string error_of(const std::string& yaml) {
  const TemporaryFolder folder;
  folder.write("n.onnx", "x");
  const auto model = read_segmentation_model(folder.write("model.yaml", yaml));
  return model ? "no error" : model.error().message;
}

TEST(SegmentationModelTest, EveryKeyIsRead) {
  const TemporaryFolder folder;
  folder.write("n.onnx", "x");
  folder.write("model.yaml",
               "format: 1\nname: N\nnetwork: n.onnx\n"
               "input: {width: 8, height: 4, channels: bgr, mean: [1, 2, 3], scale: 0.5}\n"
               "output: probabilities\noutput_name: out\nclasses: [a, b, c]\nunknown: [b]\n");
  const Result<SegmentationModel> model = read_segmentation_model(folder.path());
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->name, "N");
  EXPECT_EQ(model->input_columns, 8);
  EXPECT_EQ(model->input_rows, 4);
  EXPECT_TRUE(model->bgr);
  EXPECT_EQ(model->mean, (std::array<double, 3>{1.0, 2.0, 3.0}));
  EXPECT_EQ(model->scale, (std::array<double, 3>{0.5, 0.5, 0.5}));
  EXPECT_EQ(model->output, NetworkOutput::kProbabilities);
  EXPECT_EQ(model->output_name, "out");
  EXPECT_EQ(model->class_of_channel, (std::vector<ClassId>{1, kUnknown, 2}));
  EXPECT_EQ(model->classes(), ClassTable({"a", "c"}));
}

TEST(SegmentationModelTest, FaultsNameFileAndLine) {
  EXPECT_EQ(error_of(kHead + kInput + kTail), "no error");
  EXPECT_THAT(error_of("format: 2\n"), HasSubstr("model.yaml:1: format 2, this version reads 1"));
  EXPECT_THAT(error_of("format: 1\nnetwork: none.onnx\n" + kInput + kTail),
              HasSubstr("none.onnx is no file"));
  EXPECT_THAT(error_of(kHead + "input: {width: 0, height: 4}\n" + kTail),
              HasSubstr("model.yaml:3: width 0, expected 1 to 4096"));
  EXPECT_THAT(error_of(kHead + "input: {width: 8, height: 4, channels: grb}\n" + kTail),
              HasSubstr("channels 'grb', expected rgb or bgr"));
  for (const std::string scale : {"0", "1e-9", "1e9", "[1, 0, 1]"}) {
    EXPECT_THAT(error_of(kHead + "input: {width: 8, height: 4, scale: " + scale + "}\n" + kTail),
                HasSubstr("expected 1e-06 to 1000"));
  }
  EXPECT_THAT(error_of(kHead + kInput + "output: masks\nclasses: [a]\n"),
              HasSubstr("model.yaml:4: output 'masks'"));
  EXPECT_THAT(error_of(kHead + kInput + "output: logits\nclasses: [a, a]\n"),
              HasSubstr("class 'a' twice"));
  EXPECT_THAT(error_of(kHead + kInput + kTail + "unknown: [c]\n"),
              HasSubstr("model.yaml:6: 'c' is none of the classes"));
  EXPECT_THAT(error_of(kHead + kInput + kTail + "unknown: [a, b]\n"),
              HasSubstr("every class is listed as unknown"));
}

TEST(SegmentationModelTest, AModelIsFoundByNameFolderOrFile) {
  const TemporaryFolder folder;
  const auto file = folder.write("models/small/model.yaml", "");
  const auto models = folder / "models";
  EXPECT_EQ(*find_segmentation_model("small", models), file);
  EXPECT_EQ(*find_segmentation_model(file.string(), models), file);
  EXPECT_EQ(*find_segmentation_model(file.parent_path().string(), folder / "elsewhere"), file);
  const auto missing = find_segmentation_model("large", models);
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message, HasSubstr("large: no such model"));
  EXPECT_EQ(missing.error().hint, "there: small");
}

}  // namespace
}  // namespace semview::segmentation
