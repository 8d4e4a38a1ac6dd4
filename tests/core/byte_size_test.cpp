// SPDX-License-Identifier: Apache-2.0
#include "semview/core/byte_size.hpp"

#include <gtest/gtest.h>

namespace semview {
namespace {

TEST(ByteSizeTest, UnitsArePowersOf1024) {
  EXPECT_EQ(*parse_byte_size("--limit", "0"), 0U);
  EXPECT_EQ(*parse_byte_size("--limit", "1234"), 1234U);
  EXPECT_EQ(*parse_byte_size("--limit", "3K"), 3072U);
  EXPECT_EQ(*parse_byte_size("--limit", "500M"), 524'288'000U);
  EXPECT_EQ(*parse_byte_size("--limit", "20G"), 21'474'836'480U);
  EXPECT_EQ(*parse_byte_size("--limit", "2T"), 2'199'023'255'552U);
}

TEST(ByteSizeTest, WhatIsNoNumberOfBytesIsRefusedByItsOption) {
  for (const char* const text : {"",
                                 "-1",
                                 "+1",
                                 " 1",
                                 "1.5G",
                                 "10GB",
                                 "10g",
                                 "G",
                                 "1KK",
                                 "x",
                                 "99999999999999999999",
                                 "99999999999T"}) {
    const auto bytes = parse_byte_size("--limit", text);
    ASSERT_FALSE(bytes) << text;
    EXPECT_EQ(bytes.error().field, "--limit");
    EXPECT_EQ(bytes.error().message,
              "--limit " + std::string(text) + ": expected a number of bytes, such as 500M or 20G");
  }
}

}  // namespace
}  // namespace semview
