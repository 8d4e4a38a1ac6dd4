// SPDX-License-Identifier: Apache-2.0
#include "semview/core/hash.hpp"

#include <string_view>

#include <gtest/gtest.h>

namespace semview {
namespace {

Fingerprint of(std::string_view bytes) {
  Hasher hasher;
  hasher.add_bytes(std::as_bytes(std::span(bytes)));
  return hasher.digest();
}

// Known answers: the test vectors of the xxHash specification for an empty input.
TEST(HashTest, EmptyInputGivesThePublishedValues) {
  EXPECT_EQ(hash64({}), 0x2d06800538d394c2U);
  EXPECT_EQ(to_hex(of("")), "99aa06d3014798d86001c324468d497f");
}

TEST(HasherTest, TheWayBytesAreSplitDoesNotMatter) {
  Hasher hasher;
  for (const char c : std::string_view("semview")) {
    hasher.add_bytes(std::as_bytes(std::span(&c, 1)));
  }
  EXPECT_EQ(hasher.digest(), of("semview"));
}

TEST(HasherTest, NumbersAreLittleEndianBytes) {
  Hasher hasher;
  hasher.add_u32(0x64636261U);
  EXPECT_EQ(hasher.digest(), of("abcd"));
}

TEST(HasherTest, TextsThatJoinToTheSameBytesDiffer) {
  Hasher first;
  first.add_string("ab");
  first.add_string("c");
  Hasher second;
  second.add_string("a");
  second.add_string("bc");
  EXPECT_NE(first.digest(), second.digest());
}

TEST(HasherTest, MinusZeroCountsAsZero) {
  Hasher positive;
  positive.add_f64(0.0);
  Hasher negative;
  negative.add_f64(-0.0);
  EXPECT_EQ(positive.digest(), negative.digest());
}

}  // namespace
}  // namespace semview
