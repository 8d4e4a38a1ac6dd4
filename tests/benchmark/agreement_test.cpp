// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/agreement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semview::benchmark::detail {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// 200 000 pixels that see class 1, but for the first `different`.
LabelImage labels(std::size_t different) {
  LabelImage image(400, 500, 1);
  for (std::size_t i = 0; i < different; ++i) image.pixels()[i] = 2;
  return image;
}

bool passes(double ties, std::size_t different) {
  Agreement agreement(ties);
  agreement.add_labels(labels(0), labels(different));
  return static_cast<bool>(agreement.check());
}

TEST(AgreementTest, EnginesMayDifferInAMillionthAndPeersInMore) {
  EXPECT_TRUE(passes(kTiesOfEngines, 4));  // never fewer than a few
  EXPECT_FALSE(passes(kTiesOfEngines, 5));
  EXPECT_TRUE(passes(kTiesOfPeers, 10));
  EXPECT_FALSE(passes(kTiesOfPeers, 11));
}

TEST(AgreementTest, RangesAreSpokenOfOnlyWhereTheyWereCompared) {
  const raycast::Panorama with{labels(0), RangeImage(400, 500, 2.0F)};
  const raycast::Panorama without{labels(0), RangeImage()};
  Agreement of_labels(kTiesOfEngines);
  of_labels.add(with, without);
  EXPECT_THAT(of_labels.text(), Not(HasSubstr("range")));
  Agreement of_both(kTiesOfEngines);
  of_both.add(with, with);
  EXPECT_THAT(of_both.text(), HasSubstr("ranges within 0 mm"));
}

}  // namespace
}  // namespace semview::benchmark::detail
