// SPDX-License-Identifier: Apache-2.0
#include "semview/io/instance_masks.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/io/png.hpp"
#include "semview/io/text_file.hpp"
#include "support/temporary_folder.hpp"

namespace semview::io {
namespace {

constexpr ClassId kSofa = 1;
constexpr ClassId kTable = 2;

class InstanceMasksTest : public ::testing::Test {
 protected:
  /// A mask of 2 × 4 pixels that covers columns `first` to `last`.
  void mask(const std::string& name, int first, int last) {
    Image<std::uint8_t> covered(2, 4);
    for (int r = 0; r < 2; ++r) {
      for (int c = first; c <= last; ++c) covered.at(r, c) = 255;
    }
    ASSERT_TRUE(write_png(folder_ / name, covered));
  }
  Result<LabelImage> read(const std::string& lines) {
    EXPECT_TRUE(write_text_file(folder_ / "a.csv", lines));
    return read_instance_masks(folder_ / "a.csv", ClassTable({"sofa", "coffee table"}));
  }
  std::string refusal(const std::string& lines) {
    const Result<LabelImage> labels = read(lines);
    return labels ? "" : labels.error().message;
  }

  testing::TemporaryFolder folder_;
};

TEST_F(InstanceMasksTest, APixelHasTheClassOfTheMaskWithTheHighestScore) {
  mask("0.png", 0, 2);
  mask("1.png", 1, 1);
  mask("2.png", 2, 2);
  const Result<LabelImage> labels =
      read("mask,class,score\n0.png,sofa,0.6\n1.png,coffee table,0.9\n2.png,coffee table,0.6\n");
  ASSERT_TRUE(labels) << labels.error().message;
  EXPECT_EQ(labels->at(1, 0), kSofa);
  EXPECT_EQ(labels->at(1, 1), kTable);
  EXPECT_EQ(labels->at(1, 2), kSofa);  // as sure: the first
  EXPECT_EQ(labels->at(1, 3), kNoHit);
}

TEST_F(InstanceMasksTest, AFrameWithoutObjectsHasNoLabels) {
  const Result<LabelImage> labels = read("mask,class,score\n");
  ASSERT_TRUE(labels);
  EXPECT_TRUE(labels->empty());
}

TEST_F(InstanceMasksTest, WhatIsWrongIsNamedByFileAndLine) {
  using ::testing::HasSubstr;
  mask("0.png", 0, 2);
  ASSERT_TRUE(write_png(folder_ / "small.png", Image<std::uint8_t>(1, 1, 255)));
  EXPECT_THAT(refusal("file,class\n"), HasSubstr("a.csv:1: expected the header"));
  EXPECT_THAT(refusal("mask,class,score\n0.png,lamp,0.5\n"), HasSubstr("a.csv:2: class 'lamp'"));
  EXPECT_THAT(refusal("mask,class,score\n0.png,sofa,7\n"), HasSubstr("a.csv:2: score '7'"));
  EXPECT_THAT(refusal("mask,class,score\n0.png\n"), HasSubstr("a.csv:2: expected mask"));
  EXPECT_THAT(refusal("mask,class,score\n0.png,sofa,1\nsmall.png,sofa,0.4\n"),
              HasSubstr("a.csv:3: a mask of 1 x 1 pixels, another has 4 x 2"));
  EXPECT_EQ(read("mask,class,score\nnone.png,sofa,1\n").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace semview::io
