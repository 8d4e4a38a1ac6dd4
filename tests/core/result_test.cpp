// SPDX-License-Identifier: Apache-2.0
#include "semview/core/result.hpp"

#include <memory>

#include <gtest/gtest.h>

namespace semview {
namespace {

Result<int> half(int number) {
  if (number % 2 != 0) return fail(ErrorCode::kInvalidArgument, "odd number");
  return number / 2;
}

Result<std::unique_ptr<int>> quarter(int number) {
  SEMVIEW_TRY(const int halved, half(number));
  SEMVIEW_TRY(const int quartered, half(halved));
  return std::make_unique<int>(quartered);
}

Status must_be_even(int number) {
  SEMVIEW_TRY_STATUS(half(number));
  return {};
}

TEST(ResultTest, TryPassesValuesAndErrorsOn) {
  EXPECT_EQ(**quarter(12), 3);
  ASSERT_FALSE(quarter(6));
  EXPECT_EQ(quarter(6).error().message, "odd number");
  EXPECT_TRUE(must_be_even(2));
  EXPECT_EQ(must_be_even(1).error().code, ErrorCode::kInvalidArgument);
}

TEST(ResultTest, ContextStandsBeforeTheMessageAndKeepsTheRest) {
  const auto with_field = []() -> Result<int> {
    return fail(Error{ErrorCode::kNotFound, "no such class", "below", "list it", 5});
  };
  const Result<int> result = with_context(with_field(), "map.yaml:3");
  EXPECT_EQ(result.error().message, "map.yaml:3: no such class");
  EXPECT_EQ(result.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(result.error().field, "below");
  EXPECT_EQ(result.error().hint, "list it");
  EXPECT_EQ(result.error().retry_after_ms, 5U);
}

// The numbers and names that gRPC publishes.
TEST(ErrorCodeTest, NumbersAndNamesAreThoseOfGrpc) {
  EXPECT_EQ(static_cast<int>(ErrorCode::kInvalidArgument), 3);
  EXPECT_EQ(static_cast<int>(ErrorCode::kResourceExhausted), 8);
  EXPECT_EQ(static_cast<int>(ErrorCode::kDataLoss), 15);
  EXPECT_EQ(name(ErrorCode::kDataLoss), "DATA_LOSS");
  EXPECT_EQ(name(ErrorCode::kDeadlineExceeded), "DEADLINE_EXCEEDED");
}

}  // namespace
}  // namespace semview
