// SPDX-License-Identifier: Apache-2.0
// Drawings whose edges were smoothed or whose colours were disturbed, read with `nearest_colour`.
#include <algorithm>

#include <gtest/gtest.h>

#include "semview/core/random.hpp"
#include "semview/io/png.hpp"
#include "semview/map/semantic_map.hpp"
#include "support/paths.hpp"
#include "support/temporary_folder.hpp"

namespace semview::map {
namespace {

class SmoothedDrawingTest : public ::testing::Test {
 protected:
  void SetUp() override {
    exact_ = io::read_png_rgb(kMap / "labels.png").value();
    truth_ = load_map(kMap).value().columns()->profile_of_pixel;
    std::filesystem::copy(kMap, folder_.path(), std::filesystem::copy_options::recursive);
  }

  Image<std::uint8_t> read(const RgbImage& drawing) const {
    EXPECT_TRUE(io::write_png(folder_.path() / "labels.png", drawing));
    const auto map = load_map(folder_.path(), {true});
    EXPECT_TRUE(map) << map.error().message;
    return map ? map->columns()->profile_of_pixel : Image<std::uint8_t>();
  }

  /// The drawing, each pixel the mean of the square of pixels around it.
  RgbImage smoothed(int reach) const {
    RgbImage out = exact_;
    for (int row = 0; row < out.rows(); ++row) {
      for (int column = 0; column < out.columns(); ++column) {
        int sum[3] = {0, 0, 0};
        int count = 0;
        for_each_near(row, column, reach, [&](int r, int c) {
          const Rgb color = exact_.at(r, c);
          sum[0] += color.r;
          sum[1] += color.g;
          sum[2] += color.b;
          ++count;
        });
        out.at(row, column) = {static_cast<std::uint8_t>(sum[0] / count),
                               static_cast<std::uint8_t>(sum[1] / count),
                               static_cast<std::uint8_t>(sum[2] / count)};
      }
    }
    return out;
  }

  template <typename Visit>
  void for_each_near(int row, int column, int reach, Visit&& visit) const {
    for (int r = std::max(0, row - reach); r <= std::min(exact_.rows() - 1, row + reach); ++r) {
      for (int c = std::max(0, column - reach); c <= std::min(exact_.columns() - 1, column + reach);
           ++c) {
        visit(r, c);
      }
    }
  }

  const std::filesystem::path kMap = SEMVIEW_SOURCE_DIR "/maps/tutorial";
  testing::TemporaryFolder folder_;
  RgbImage exact_;
  Image<std::uint8_t> truth_;
};

TEST_F(SmoothedDrawingTest, AnEdgeBetweenTwoClassesNeverLooksLikeAThird) {
  const Image<std::uint8_t> found = read(smoothed(1));
  int strange = 0;
  int different = 0;
  for (int row = 0; row < truth_.rows(); ++row) {
    for (int column = 0; column < truth_.columns(); ++column) {
      const std::uint8_t profile = found.at(row, column);
      different += profile != truth_.at(row, column) ? 1 : 0;
      bool near = false;
      for_each_near(row, column, 3, [&](int r, int c) { near |= truth_.at(r, c) == profile; });
      strange += near ? 0 : 1;
    }
  }
  EXPECT_EQ(strange, 0);
  EXPECT_LT(different, truth_.rows() * truth_.columns() / 100);
}

TEST_F(SmoothedDrawingTest, TheNoiseOfACompressedPictureChangesNothing) {
  Rng rng(3, "noise");
  RgbImage noisy = exact_;
  const auto disturb = [&](std::uint8_t value) {
    const int moved = value + static_cast<int>(rng.below(17)) - 8;
    return static_cast<std::uint8_t>(std::clamp(moved, 0, 255));
  };
  for (Rgb& color : noisy.pixels()) color = {disturb(color.r), disturb(color.g), disturb(color.b)};
  EXPECT_EQ(read(noisy), truth_);
}

}  // namespace
}  // namespace semview::map
