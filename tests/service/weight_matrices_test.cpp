// SPDX-License-Identifier: Apache-2.0
#include "semview/service/weight_matrices.hpp"

#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace semview::service {
namespace {

std::string csv_of(int weight) { return fmt::format("observed,wall,none\nwall,{},0\n", weight); }

TEST(WeightMatricesTest, ATextIsReadOnceAndGivesWhatItSays) {
  WeightMatrices matrices;
  const auto first = matrices.read(csv_of(1), "weights_csv");
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_EQ(**first, *similarity::parse_weight_matrix(csv_of(1), "weights_csv"));
  EXPECT_EQ(*matrices.read(csv_of(1), "weights_csv"), *first);
  EXPECT_EQ(matrices.kept(), 1U);
  const auto other = matrices.read(csv_of(2), "weights_csv");
  EXPECT_EQ((*other)->weight(0, 0, 0), 2.0);
}

TEST(WeightMatricesTest, TheTextsUsedLastAreKept) {
  WeightMatrices matrices;
  const auto first = *matrices.read(csv_of(0), "weights_csv");
  for (int i = 1; i < static_cast<int>(2 * WeightMatrices::kMaxKept); ++i) {
    ASSERT_TRUE(matrices.read(csv_of(i), "weights_csv"));
    EXPECT_EQ(*matrices.read(csv_of(0), "weights_csv"), first);
  }
  EXPECT_EQ(matrices.kept(), WeightMatrices::kMaxKept);
}

TEST(WeightMatricesTest, WhatCannotBeReadIsNotKept) {
  WeightMatrices matrices;
  EXPECT_EQ(matrices.read("observed,wall\nwall,heavy\n", "weights_csv").error().code,
            ErrorCode::kInvalidArgument);
  EXPECT_EQ(matrices.kept(), 0U);
}

}  // namespace
}  // namespace semview::service
