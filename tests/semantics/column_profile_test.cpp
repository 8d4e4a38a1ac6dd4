// SPDX-License-Identifier: Apache-2.0
#include "semview/semantics/column_profile.hpp"

#include <gtest/gtest.h>

namespace semview {
namespace {

TEST(ColumnProfileTest, ASlabThatOnlyTouchesDoesNotReachInto) {
  ColumnProfile profile;
  profile.slabs = {{0.7, 0.75, 1}};
  EXPECT_TRUE(profile.reaches_into(0.05, 1.2));
  EXPECT_TRUE(profile.reaches_into(0.72, 0.73));
  EXPECT_FALSE(profile.reaches_into(0.75, 1.2));
  EXPECT_FALSE(profile.reaches_into(0.05, 0.7));
}

TEST(ColumnProfileTest, AnEmptyColumnReachesNowhere) {
  EXPECT_FALSE(ColumnProfile{}.reaches_into(0.0, 10.0));
}

}  // namespace
}  // namespace semview
