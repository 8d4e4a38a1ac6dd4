// SPDX-License-Identifier: Apache-2.0
#include "semview/io/photo.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/core/random.hpp"
#include "semview/io/exif.hpp"
#include "semview/io/jpeg.hpp"
#include "semview/io/png.hpp"
#include "support/jpeg_file.hpp"
#include "support/temporary_folder.hpp"

namespace semview::io {
namespace {

using semview::testing::jpeg_bytes;
using semview::testing::TemporaryFolder;
using ::testing::HasSubstr;

/// Smooth in both directions, and no two corners alike.
RgbImage slopes(int rows, int columns) {
  RgbImage image(rows, columns);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      image.at(r, c) = {static_cast<unsigned char>(200 * r / rows),
                        static_cast<unsigned char>(200 * c / columns),
                        60};
    }
  }
  return image;
}

bool alike(const RgbImage& a, const RgbImage& b) {
  if (a.rows() != b.rows() || a.columns() != b.columns()) return false;
  const auto near = [](int x, int y) { return std::abs(x - y) <= 4; };
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const Rgb p = a.pixels()[i];
    const Rgb q = b.pixels()[i];
    if (!near(p.r, q.r) || !near(p.g, q.g) || !near(p.b, q.b)) return false;
  }
  return true;
}

TEST(PhotoTest, TheContentAndNotTheNameSaysWhatItIs) {
  const TemporaryFolder folder;
  const RgbImage image = slopes(24, 40);
  const auto jpeg = folder.write("is_jpeg.png", jpeg_bytes(image));
  ASSERT_TRUE(write_png(folder / "is_png.jpg", image));
  EXPECT_EQ(*read_photo(folder / "is_png.jpg"), image);
  const Result<RgbImage> read = read_photo(jpeg);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(alike(*read, image));
  const Result<RgbImage> progressive =
      read_photo(folder.write("p.jpg", jpeg_bytes(image, 0, true)));
  ASSERT_TRUE(progressive) << progressive.error().message;
  EXPECT_TRUE(alike(*progressive, image));
}

TEST(PhotoTest, WhatIsNoPictureSaysSo) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_photo(folder / "none.jpg").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(read_photo(folder.path()).error().code, ErrorCode::kNotFound);
  const Result<RgbImage> text = read_photo(folder.write("a.jpg", "hello"));
  EXPECT_EQ(text.error().code, ErrorCode::kDataLoss);
  EXPECT_THAT(text.error().message, HasSubstr("neither a PNG nor a JPEG"));
  EXPECT_EQ(read_photo(folder.write("b.jpg", "")).error().code, ErrorCode::kDataLoss);
  EXPECT_EQ(read_photo(folder.write("c.jpg", "\xff\xd8\xff")).error().code, ErrorCode::kDataLoss);
}

TEST(PhotoTest, AJpegThatIsCutShortIsAnErrorWhereverItIsCut) {
  const TemporaryFolder folder;
  const std::string whole = jpeg_bytes(slopes(32, 32));
  for (std::size_t length = 2; length + 2 < whole.size(); length += 37) {
    const Result<RgbImage> read = read_jpeg(folder.write("cut.jpg", whole.substr(0, length)));
    ASSERT_FALSE(read) << length << " of " << whole.size() << " bytes";
    EXPECT_EQ(read.error().code, ErrorCode::kDataLoss);
  }
}

TEST(PhotoTest, ADamagedJpegIsAnErrorOrAPictureAndNeverACrash) {
  const TemporaryFolder folder;
  const std::string whole = jpeg_bytes(slopes(32, 48), 6, true);
  Rng rng(11);
  for (int i = 0; i < 100; ++i) {
    std::string damaged = whole;
    for (int k = 0; k < 3; ++k) {
      damaged[2 + rng.below(damaged.size() - 2)] = static_cast<char>(rng.below(256));
    }
    const Result<RgbImage> read = read_photo(folder.write("damaged.jpg", damaged));
    if (read) {
      EXPECT_FALSE(read->empty());
    } else {
      EXPECT_FALSE(read.error().message.empty());
    }
  }
}

TEST(PhotoTest, AnExifOrientationIsUndone) {
  const TemporaryFolder folder;
  const RgbImage image = slopes(16, 24);
  // Stored turned left (row 0 of the file is the picture's right side): 6 asks for a quarter turn
  // clockwise.
  RgbImage stored(24, 16);
  for (int r = 0; r < 16; ++r) {
    for (int c = 0; c < 24; ++c) stored.at(23 - c, r) = image.at(r, c);
  }
  const Result<RgbImage> read = read_jpeg(folder.write("turned.jpg", jpeg_bytes(stored, 6)));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(alike(*read, image));
}

TEST(ExifTest, EachOrientationPutsTheStoredCornerWhereItBelongs) {
  // 1 2 3 / 4 5 6 as stored; the upright pictures, row by row.
  RgbImage stored(2, 3);
  for (int i = 0; i < 6; ++i)
    stored.pixels()[static_cast<std::size_t>(i)].r = static_cast<unsigned char>(i + 1);
  const auto reds = [&](int orientation) {
    const RgbImage image = upright(stored, static_cast<Orientation>(orientation));
    std::string text;
    for (int r = 0; r < image.rows(); ++r) {
      for (int c = 0; c < image.columns(); ++c) text += std::to_string(image.at(r, c).r);
      text += '/';
    }
    return text;
  };
  EXPECT_EQ(reds(1), "123/456/");
  EXPECT_EQ(reds(2), "321/654/");
  EXPECT_EQ(reds(3), "654/321/");
  EXPECT_EQ(reds(4), "456/123/");
  EXPECT_EQ(reds(5), "14/25/36/");
  EXPECT_EQ(reds(6), "41/52/63/");
  EXPECT_EQ(reds(7), "63/52/41/");
  EXPECT_EQ(reds(8), "36/25/14/");
}

TEST(ExifTest, ABlockThatIsNotSoundSaysNothing) {
  const std::string exif("Exif\0\0II\x2a\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x08\0\0\0", 28);
  const auto orientation = [](const std::string& text) {
    return exif_orientation({reinterpret_cast<const unsigned char*>(text.data()), text.size()});
  };
  EXPECT_EQ(orientation(exif), Orientation::kTurnedRight);
  for (std::size_t length = 0; length < 26; ++length) {
    EXPECT_EQ(orientation(exif.substr(0, length)), Orientation::kUpright) << length;
  }
  std::string far = exif;
  far[10] = '\xf0';  // a directory past the end
  EXPECT_EQ(orientation(far), Orientation::kUpright);
  std::string ninth = exif;
  ninth[24] = 9;
  EXPECT_EQ(orientation(ninth), Orientation::kUpright);
}

}  // namespace
}  // namespace semview::io
