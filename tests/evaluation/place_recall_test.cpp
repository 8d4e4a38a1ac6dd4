// SPDX-License-Identifier: Apache-2.0
#include "semview/evaluation/place_recall.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "semview/geometry/angle.hpp"

namespace semview::evaluation {
namespace {

TEST(PlaceRecallTest, CountsWithinDistanceAndGate) {
  const std::vector<PlaceError> errors{
      {0.05, rad_from_deg(2.0), 0.9},
      {0.20, rad_from_deg(8.0), 0.8},
      {0.40, rad_from_deg(20.0), 0.5},
      {std::numeric_limits<double>::infinity(), kPi, 0.0},
  };
  const PlaceRecall recall = recall_of(errors);
  EXPECT_EQ(recall.pictures, 4U);
  EXPECT_EQ(recall.recall[0], (std::array<double, 4>{0.25, 0.5, 0.75, 0.75}));  // no gate
  EXPECT_EQ(recall.recall[1], (std::array<double, 4>{0.25, 0.5, 0.75, 0.75}));  // 30°
  EXPECT_EQ(recall.recall[2], (std::array<double, 4>{0.25, 0.5, 0.5, 0.5}));    // 10°
  EXPECT_EQ(recall.recall[3], (std::array<double, 4>{0.25, 0.25, 0.25, 0.25}));
  EXPECT_EQ(recall.located, 0.5);
  EXPECT_EQ(recall.median_m, 0.40);
  EXPECT_NEAR(recall.mean_probability, 0.55, 1e-12);
}

TEST(PlaceRecallTest, HeadingErrorsGoTheShorterWay) {
  const PlaceError error =
      place_error({3.0, 4.0, rad_from_deg(-175.0)}, {0.0, 0.0, rad_from_deg(175.0)}, 0.3);
  EXPECT_EQ(error.position_m, 5.0);
  EXPECT_NEAR(deg_from_rad(error.heading_rad), 10.0, 1e-9);
}

TEST(PlaceRecallTest, NoPicturesAreNoRecall) { EXPECT_EQ(recall_of({}).pictures, 0U); }

}  // namespace
}  // namespace semview::evaluation
