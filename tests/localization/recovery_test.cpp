// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/recovery.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace semview::localization {
namespace {

TEST(RecoveryTest, SteadyOrBetterObservationsReplaceNothing) {
  RecoveryMonitor monitor({});
  for (int i = 0; i < 20; ++i) EXPECT_EQ(monitor.share_to_replace(0.5), 0.0);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(monitor.share_to_replace(0.5 + 0.01 * i), 0.0);
}

TEST(RecoveryTest, TheShareIsOneMinusTheQuotientOfTheAverages) {
  const RecoveryConfig config{
      .recovery_alpha_slow = 0.1, .recovery_alpha_fast = 0.5, .most_share = 1.0};
  RecoveryMonitor monitor(config);
  double slow = 0.6;
  double fast = 0.6;
  EXPECT_EQ(monitor.share_to_replace(0.6), 0.0);
  for (const double average : {0.6, 0.2, 0.3, 0.6, 0.7, 0.7, 0.7}) {
    slow += 0.1 * (average - slow);
    fast += 0.5 * (average - fast);
    EXPECT_NEAR(monitor.share_to_replace(average), std::max(0.0, 1.0 - fast / slow), 1e-12);
  }
}

TEST(RecoveryTest, NeverMoreThanTheMostAndNumbersThatAreNoneSayNothing) {
  RecoveryMonitor monitor({.most_share = 0.3});
  EXPECT_EQ(monitor.share_to_replace(1.0), 0.0);
  EXPECT_EQ(monitor.share_to_replace(NAN), 0.0);
  EXPECT_EQ(monitor.share_to_replace(0.0), 0.3);
}

TEST(RecoveryTest, ParametersOutOfRangeAreNamed) {
  EXPECT_TRUE(validate(RecoveryConfig{}));
  EXPECT_EQ(validate(RecoveryConfig{.recovery_alpha_slow = 0.0}).error().field,
            "recovery_alpha_slow");
  EXPECT_EQ(validate(RecoveryConfig{.recovery_alpha_fast = 0.01}).error().field,
            "recovery_alpha_fast");
  EXPECT_EQ(validate(RecoveryConfig{.most_share = 0.0}).error().field, "most_share");
}

}  // namespace
}  // namespace semview::localization
