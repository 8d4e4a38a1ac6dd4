// SPDX-License-Identifier: Apache-2.0
// As the property in columns_test.cpp, on so many pixels that ties can be held to one in a million.
#include <gtest/gtest.h>

#include "raycast/column_comparison.hpp"

namespace semview::raycast {
namespace {

TEST(ColumnsSlowTest, AnyPlanLooksAsEmbreeSeesIt) {
  const ColumnComparison comparison = compare_on_any_plans(2, 1500, 4);
  EXPECT_EQ(comparison.wrong, 0) << comparison;
  EXPECT_LE(comparison.ties, comparison.pixels / 1'000'000) << comparison;
  EXPECT_GT(comparison.pixels, 50'000'000);
}

}  // namespace
}  // namespace semview::raycast
