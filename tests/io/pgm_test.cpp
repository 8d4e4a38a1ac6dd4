// SPDX-License-Identifier: Apache-2.0
#include "semview/io/pgm.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace semview::io {
namespace {

using semview::testing::TemporaryFolder;
using namespace std::string_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(PgmTest, ReadsBinaryWithComments) {
  const TemporaryFolder folder;
  const auto path =
      folder.write("a.pgm", "P5\n# made by hand\n3 # wide\n2\n255\n\x00\x01\xff\x02\x03\n"s);
  const Result<Image<std::uint8_t>> image = read_pgm(path);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->rows(), 2);
  EXPECT_EQ(image->columns(), 3);
  EXPECT_THAT(image->pixels(), ElementsAre(0, 1, 255, 2, 3, '\n'));
}

TEST(PgmTest, ReadsTextAndScalesToEightBits) {
  const TemporaryFolder folder;
  const Result<Image<std::uint8_t>> image =
      read_pgm(folder.write("a.pgm", "P2\n2 2\n4\n0 1\n# half\n2 4\n"));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_THAT(image->pixels(), ElementsAre(0, 64, 128, 255));
}

TEST(PgmTest, RefusesWhatItCannotRead) {
  const TemporaryFolder folder;
  const auto code = [&](const std::string& bytes) {
    return read_pgm(folder.write("a.pgm", bytes)).error().code;
  };
  EXPECT_EQ(code("P6\n1 1\n255\nabc"), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code("P5\n1 x"), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code("P5\n1 -1 255\na"), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code("P5\n1 1\n65535\nab"), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code("P5\n2 2\n255\nabc"), ErrorCode::kDataLoss);
  EXPECT_EQ(code("P5\n2000000 2000000\n255\n"), ErrorCode::kOutOfRange);
  EXPECT_EQ(code("P5\n99999999999 1\n255\n"), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code("P2\n2 1\n4\n1 5\n"), ErrorCode::kDataLoss);
}

TEST(PgmTest, ASampleAboveTheLargestNamesItsPixel) {
  const TemporaryFolder folder;
  EXPECT_THAT(read_pgm(folder.write("a.pgm", "P2\n2 1\n4\n1 5\n")).error().message,
              HasSubstr("row 0, column 1: value 5, expected 0 to 4"));
}

}  // namespace
}  // namespace semview::io
