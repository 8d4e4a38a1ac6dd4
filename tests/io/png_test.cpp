// SPDX-License-Identifier: Apache-2.0
#include "semview/io/png.hpp"

#include <array>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/core/random.hpp"
#include "support/temporary_folder.hpp"

namespace semview::io {
namespace {

using semview::testing::file_bytes;
using semview::testing::TemporaryFolder;
using ::testing::HasSubstr;

void append_u32(std::string& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<char>(value >> static_cast<unsigned>(shift) & 0xffU));
  }
}

// CRC and Adler as the PNG and zlib specifications define them, bit by bit.
std::uint32_t crc(const std::string& bytes) {
  std::uint32_t value = 0xffffffffU;
  for (const char byte : bytes) {
    value ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) value = value >> 1U ^ (value & 1U ? 0xedb88320U : 0U);
  }
  return ~value;
}

std::string chunk(const std::string& type, const std::string& body) {
  std::string bytes;
  append_u32(bytes, static_cast<std::uint32_t>(body.size()));
  bytes += type + body;
  append_u32(bytes, crc(type + body));
  return bytes;
}

/// A PNG whose pixels are stored, not compressed. `rows` holds a filter byte 0 before each row.
std::string png_file(std::uint32_t columns,
                     std::uint32_t rows_count,
                     int bit_depth,
                     int colour_type,
                     const std::string& rows,
                     const std::string& extra_chunks = {}) {
  std::string header;
  append_u32(header, columns);
  append_u32(header, rows_count);
  header += {static_cast<char>(bit_depth), static_cast<char>(colour_type), 0, 0, 0};
  std::string zlib("\x78\x01\x01", 3);
  const auto length = static_cast<unsigned>(rows.size());
  for (const unsigned part : {length, ~length}) {
    zlib.push_back(static_cast<char>(part & 0xffU));
    zlib.push_back(static_cast<char>(part >> 8U & 0xffU));
  }
  zlib += rows;
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char byte : rows) {
    a = (a + static_cast<unsigned char>(byte)) % 65521U;
    b = (b + a) % 65521U;
  }
  append_u32(zlib, b << 16U | a);
  return std::string("\x89PNG\r\n\x1a\n", 8) + chunk("IHDR", header) + extra_chunks +
         chunk("IDAT", zlib) + chunk("IEND", "");
}

template <typename T>
Image<T> random_image(int rows, int columns) {
  Image<T> image(rows, columns);
  Rng rng(5, "png");
  for (T& pixel : image.pixels()) pixel = static_cast<T>(rng.next_u64());
  return image;
}

TEST(PngTest, EveryKindComesBackAsWritten) {
  const TemporaryFolder folder;
  const auto grey = random_image<std::uint8_t>(7, 13);
  ASSERT_TRUE(write_png(folder / "grey.png", grey));
  EXPECT_EQ(*read_png_grey(folder / "grey.png"), grey);

  const auto deep = random_image<std::uint16_t>(5, 3);
  ASSERT_TRUE(write_png(folder / "deep.png", deep));
  EXPECT_EQ(*read_png_grey16(folder / "deep.png"), deep);

  RgbImage colours(2, 2);
  colours.at(0, 0) = {255, 0, 1};
  colours.at(1, 1) = {8, 255, 51};
  ASSERT_TRUE(write_png(folder / "rgb.png", colours));
  EXPECT_EQ(*read_png_rgb(folder / "rgb.png"), colours);

  const Result<PngSize> size = png_size(folder / "grey.png");
  EXPECT_EQ(size->rows, 7);
  EXPECT_EQ(size->columns, 13);
}

TEST(PngTest, EqualImagesMakeEqualBytes) {
  const TemporaryFolder folder;
  const auto image = random_image<std::uint8_t>(20, 20);
  ASSERT_TRUE(write_png(folder / "a.png", image));
  ASSERT_TRUE(write_png(folder / "b.png", image));
  EXPECT_EQ(file_bytes(folder / "a.png"), file_bytes(folder / "b.png"));
}

TEST(PngTest, SixteenBitsAreBigEndianInTheFile) {
  const TemporaryFolder folder;
  const auto path = folder.write("a.png", png_file(1, 1, 16, 0, std::string("\0\x12\x34", 3)));
  EXPECT_EQ(read_png_grey16(path)->at(0, 0), 0x1234);
}

TEST(PngTest, FewGreyBitsAreSpreadAndPaletteIndicesAreNot) {
  const TemporaryFolder folder;
  const std::string row("\0\x1b", 2);  // samples 0, 1, 2, 3 of two bits
  const Image<std::uint8_t> grey = *read_png_grey(folder.write("g.png", png_file(4, 1, 2, 0, row)));
  EXPECT_THAT(grey.pixels(), ::testing::ElementsAre(0, 85, 170, 255));
  const std::string palette = chunk("PLTE", std::string("\1\2\3\4\5\6\7\10\11\12\13\14", 12));
  const auto path = folder.write("p.png", png_file(4, 1, 2, 3, row, palette));
  EXPECT_THAT(read_png_grey(path)->pixels(), ::testing::ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(read_png_rgb(path)->pixels(),
              ::testing::ElementsAre(Rgb{1, 2, 3}, Rgb{4, 5, 6}, Rgb{7, 8, 9}, Rgb{10, 11, 12}));
}

TEST(PngTest, OpaqueAlphaIsReadAndRealTransparencyNamesItsPixel) {
  const TemporaryFolder folder;
  const std::string opaque("\0\1\2\3\xff\4\5\6\xff", 9);
  EXPECT_THAT(read_png_rgb(folder.write("a.png", png_file(2, 1, 8, 6, opaque)))->pixels(),
              ::testing::ElementsAre(Rgb{1, 2, 3}, Rgb{4, 5, 6}));
  const std::string clear("\0\1\2\3\xff\4\5\6\x7f", 9);
  const Result<RgbImage> image = read_png_rgb(folder.write("b.png", png_file(2, 1, 8, 6, clear)));
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(image.error().message, HasSubstr("row 0, column 1 is transparent (alpha 127)"));
}

TEST(PngTest, AColourMarkedTransparentInThePaletteIsRefusedWhereItIsUsed) {
  const TemporaryFolder folder;
  const std::string tables =
      chunk("PLTE", std::string("\1\2\3\4\5\6", 6)) + chunk("tRNS", std::string("\xff\0", 2));
  const auto used = folder.write("a.png", png_file(2, 1, 8, 3, std::string("\0\0\1", 3), tables));
  EXPECT_FALSE(read_png_rgb(used));
  const auto unused = folder.write("b.png", png_file(2, 1, 8, 3, std::string("\0\0\0", 3), tables));
  EXPECT_TRUE(read_png_rgb(unused));
}

TEST(PngTest, AnotherKindIsRefusedByName) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_png(folder / "rgb.png", RgbImage(1, 1)));
  EXPECT_THAT(read_png_grey(folder / "rgb.png").error().message,
              HasSubstr("8-bit RGB PNG, expected 8-bit grey or palette"));
  EXPECT_EQ(read_png_grey16(folder / "rgb.png").error().code, ErrorCode::kInvalidArgument);
}

TEST(PngTest, AMissingFileAndAFolderAreErrors) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_png_rgb(folder / "none.png").error().code, ErrorCode::kNotFound);
  EXPECT_FALSE(read_png_rgb(folder.path()));
}

TEST(PngTest, TooLargeIsToldFromTheHeaderAlone) {
  const TemporaryFolder folder;
  const auto wide = folder.write("a.png", png_file(20'001, 1, 8, 0, ""));
  EXPECT_EQ(png_size(wide).error().code, ErrorCode::kOutOfRange);
  const auto many = folder.write("b.png", png_file(20'000, 20'000, 8, 0, ""));
  EXPECT_EQ(read_png_grey(many).error().code, ErrorCode::kOutOfRange);
}

TEST(PngTest, EveryTruncationIsAnError) {
  const TemporaryFolder folder;
  RgbImage image(3, 5);
  image.at(1, 1) = {1, 2, 3};
  ASSERT_TRUE(write_png(folder / "a.png", image));
  const std::string bytes = file_bytes(folder / "a.png");
  // The IEND chunk's 12 bytes hold no pixel: a reader may do without them.
  for (std::size_t length = 0; length + 12 < bytes.size(); ++length) {
    const auto path = folder.write("cut.png", bytes.substr(0, length));
    EXPECT_FALSE(read_png_rgb(path)) << length;
  }
}

TEST(PngTest, AFileCutShortSaysSoAndWhatToDo) {
  const TemporaryFolder folder;
  const std::string rows(std::size_t{8} * 5, '\0');
  const std::string bytes = png_file(4, 8, 8, 0, rows);
  const auto path = folder.write("cut.png", bytes.substr(0, bytes.size() - 30));
  const auto image = read_png_grey(path);
  ASSERT_FALSE(image);
  EXPECT_THAT(image.error().message,
              HasSubstr("cut.png: is cut short: the file ends in its pixels"));
  EXPECT_THAT(image.error().hint, HasSubstr("again"));
}

TEST(PngTest, AFileThatIsNoPngSaysWhatWouldBeRight) {
  const TemporaryFolder folder;
  const auto image = read_png_rgb(folder.write("photo.png", "GIF89a and what follows"));
  ASSERT_FALSE(image);
  EXPECT_THAT(image.error().message, HasSubstr("photo.png: is not a PNG file"));
  EXPECT_THAT(image.error().hint, HasSubstr("save the picture as a PNG"));
  EXPECT_THAT(read_png_rgb(folder.path()).error().message, HasSubstr("is a folder"));
}

TEST(PngTest, DamageIsAnErrorOrAnImageOfTheSameSizeButNeverACrash) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_png(folder / "a.png", random_image<std::uint8_t>(16, 16)));
  const std::string bytes = file_bytes(folder / "a.png");
  Rng rng(9, "damage");
  for (int trial = 0; trial < 400; ++trial) {
    std::string damaged = bytes;
    for (int hit = 0; hit < 3; ++hit) {
      damaged[rng.below(damaged.size())] = static_cast<char>(rng.next_u64());
    }
    const auto path = folder.write("damaged.png", damaged);
    static_cast<void>(read_png_grey(path));
    static_cast<void>(read_png_rgb(path));
    static_cast<void>(read_png_grey16(path));
  }
}

TEST(PngTest, WhatCannotBeWrittenSaysSo) {
  const TemporaryFolder folder;
  EXPECT_EQ(write_png(folder / "a.png", RgbImage()).error().code, ErrorCode::kInvalidArgument);
  const Status status = write_png(folder / "no/such/a.png", RgbImage(1, 1));
  EXPECT_EQ(status.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(status.error().message, HasSubstr("No such file"));
}

}  // namespace
}  // namespace semview::io
