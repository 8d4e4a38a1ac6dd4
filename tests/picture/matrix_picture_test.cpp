// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/matrix_picture.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "semview/picture/colour_map.hpp"

namespace semview::picture {
namespace {

MatrixPicture of_bands(std::size_t bands, double value) {
  MatrixPicture picture;
  picture.title = "weights.csv";
  picture.row_axis = "observed";
  picture.column_axis = "map";
  picture.rows = {"wall", "floor"};
  picture.columns = {"wall", "floor", "door", "window", "table", "chair", "cupboard", "sink"};
  for (std::size_t i = 0; i < bands; ++i) {
    picture.values.emplace_back(2, 8, value);
    picture.value_names.push_back("a band");
  }
  return picture;
}

TEST(MatrixPictureTest, BandsThatDoNotFitAPageStandBelowEachOther) {
  const RgbImage one = draw_matrix(of_bands(1, 0.5));
  const RgbImage two = draw_matrix(of_bands(2, 0.5));
  const RgbImage four = draw_matrix(of_bands(4, 0.5));
  EXPECT_GT(two.columns(), one.columns());
  EXPECT_EQ(two.rows(), one.rows());
  EXPECT_EQ(four.columns(), two.columns());
  EXPECT_GT(four.rows(), two.rows());
  EXPECT_LE(four.columns(), 1200);
}

TEST(MatrixPictureTest, TheScaleShowsBothSignsWhateverTheValuesAre) {
  const RgbImage picture = draw_matrix(of_bands(1, 0.5));
  const auto shows = [&](double share) {
    return std::ranges::find(picture.pixels(), diverging(share)) != picture.pixels().end();
  };
  EXPECT_TRUE(shows(1.0));
  EXPECT_TRUE(shows(-1.0));
}

}  // namespace
}  // namespace semview::picture
