// SPDX-License-Identifier: Apache-2.0
#include "semview/io/npy.hpp"

#include <cstring>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace semview::io {
namespace {

using semview::testing::file_bytes;
using semview::testing::TemporaryFolder;

TEST(NpyTest, HeaderAndValuesAreAsNumpyDefinesThem) {
  const TemporaryFolder folder;
  Image<float> image(2, 3);
  image.at(0, 1) = 1.5F;
  image.at(1, 2) = std::numeric_limits<float>::infinity();
  ASSERT_TRUE(write_npy(folder / "a.npy", image));
  const std::string bytes = file_bytes(folder / "a.npy");
  // Format description of numpy.lib.format, version 1.0.
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t data = bytes.size() - 2 * 3 * sizeof(float);
  EXPECT_EQ(data % 64, 0U);
  const auto header_size = static_cast<std::size_t>(static_cast<unsigned char>(bytes[8])) +
                           256U * static_cast<unsigned char>(bytes[9]);
  EXPECT_EQ(10 + header_size, data);
  EXPECT_EQ(bytes[data - 1], '\n');
  EXPECT_THAT(bytes.substr(10),
              ::testing::StartsWith("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }"));
  std::array<float, 6> values{};
  std::memcpy(values.data(), bytes.data() + data, sizeof(values));
  EXPECT_EQ(values[1], 1.5F);
  EXPECT_EQ(values[5], std::numeric_limits<float>::infinity());
}

TEST(NpyTest, IntegersHaveTheirOwnType) {
  const TemporaryFolder folder;
  Image<std::int32_t> image(1, 1, -2);
  ASSERT_TRUE(write_npy(folder / "a.npy", image));
  const std::string bytes = file_bytes(folder / "a.npy");
  EXPECT_THAT(bytes, ::testing::HasSubstr("'descr': '<i4'"));
  EXPECT_EQ(bytes.substr(bytes.size() - 4), std::string("\xfe\xff\xff\xff", 4));
}

}  // namespace
}  // namespace semview::io
