// SPDX-License-Identifier: Apache-2.0
#include "work_costs.hpp"

#include <chrono>
#include <string>

#include <gtest/gtest.h>

namespace semview::server {
namespace {

using std::chrono::milliseconds;

constexpr int kMany = 200;

void add(WorkCosts& costs, const std::string& client, const Work& work, int times = 1) {
  for (int i = 0; i < times; ++i) {
    costs.add_request(client, "Score", {}, work.cells);
    costs.add_part(client, "Score", work);
  }
}

double ms(Duration time) { return std::chrono::duration<double, std::milli>(time).count(); }

TEST(WorkCostsTest, WhatWasNeverDoneIsExpectedToCostNothing) {
  const WorkCosts costs;
  EXPECT_EQ(costs.of_request("a", "Score").cells, 0U);
  EXPECT_EQ(costs.of_request("a", "Score").time, Duration::zero());
  EXPECT_EQ(costs.of_part("a", "Score", 64).cells, 64U);
  EXPECT_EQ(costs.of_part("a", "Score", 64).time, Duration::zero());
}

TEST(WorkCostsTest, AClientIsTakenForWhatItWasAndANewOneForAllTogether) {
  WorkCosts costs;
  add(costs, "warm", {100, milliseconds(1)}, kMany);
  add(costs, "cold", {300, milliseconds(300)});
  EXPECT_EQ(costs.of_request("warm", "Score").cells, 100U);
  EXPECT_NEAR(ms(costs.of_request("warm", "Score").time), 1.0, 1e-5);
  EXPECT_NEAR(ms(costs.of_request("cold", "Score").time), 300.0, 1e-5);
  const double of_new_ms = ms(costs.of_request("new", "Score").time);
  EXPECT_GT(of_new_ms, 1.0);
  EXPECT_LT(of_new_ms, 300.0);
  EXPECT_EQ(costs.of_request("warm", "Heatmap").time, Duration::zero());
}

TEST(WorkCostsTest, APartCostsItsCellsAndARequestItsPlanningToo) {
  WorkCosts costs;
  costs.add_request("a", "Score", {4, milliseconds(3)}, 2000);
  costs.add_part("a", "Score", {1000, milliseconds(10)});
  EXPECT_NEAR(ms(costs.of_part("a", "Score", 64).time), 0.64, 1e-5);
  EXPECT_EQ(costs.of_request("a", "Score").cells, 2004U);
  EXPECT_NEAR(ms(costs.of_request("a", "Score").time), 3.0 + 20.0, 1e-5);
}

TEST(WorkCostsTest, WhatWasLongAgoIsForgotten) {
  WorkCosts costs;
  add(costs, "a", {100, milliseconds(100)}, kMany);
  add(costs, "a", {100, milliseconds(1)}, kMany);
  EXPECT_NEAR(ms(costs.of_request("a", "Score").time), 1.0, 0.01);
}

TEST(WorkCostsTest, VeryManyClientsAreForgottenTogether) {
  WorkCosts costs;
  add(costs, "first", {100, milliseconds(100)});
  for (int i = 0; i < 20'000; ++i) add(costs, std::to_string(i), {100, milliseconds(1)});
  EXPECT_NEAR(ms(costs.of_request("first", "Score").time), 1.0, 0.01);
}

}  // namespace
}  // namespace semview::server
