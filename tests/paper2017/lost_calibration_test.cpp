// SPDX-License-Identifier: Apache-2.0
#include "experiments/paper2017/lost_calibration.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "semview/core/random.hpp"

namespace semview::paper2017 {
namespace {

using observation::LostModel;

/// Stops that are lost as often as the model says.
std::vector<LostStop> stops_of(const LostModel& model, std::size_t count) {
  Rng rng(1, "stops");
  std::vector<LostStop> stops(count);
  for (LostStop& stop : stops) {
    stop.features.advantage = rng.uniform(-1.0, 1.0);
    stop.features.advantage_before = rng.uniform(-1.0, 1.0);
    stop.features.mode_weight = rng.uniform();
    stop.features.log_sigma = rng.normal(-2.0, 1.0);
    stop.features.log_effective_share = rng.normal(-3.0, 1.0);
    stop.error_m = rng.uniform() < observation::lost_probability(stop.features, model) ? 5.0 : 0.1;
  }
  return stops;
}

TEST(LostCalibrationTest, TheFitFindsTheModelThatMadeTheStops) {
  const LostModel model{1.0, {-5.0, -3.0, -4.0, 0.5, -0.5}};
  const std::vector<LostStop> stops = stops_of(model, 50'000);
  const LostModel fitted = fit_lost_model(stops);
  // Four standard errors of so many stops.
  EXPECT_NEAR(fitted.intercept, model.intercept, 0.3);
  for (std::size_t i = 0; i < model.weights.size(); ++i) {
    EXPECT_NEAR(fitted.weights[i], model.weights[i], 0.3) << i;
  }
  EXPECT_LT(measure_quality(stops, fitted).calibration_error, 0.01);
}

TEST(LostCalibrationTest, AModelThatIsTooSureIsSeenInItsCalibrationError) {
  const LostModel model{0.0, {-2.0, 0.0, 0.0, 0.0, 0.0}};
  const LostModel too_sure{0.0, {-20.0, 0.0, 0.0, 0.0, 0.0}};
  const std::vector<LostStop> stops = stops_of(model, 20'000);
  EXPECT_LT(measure_quality(stops, model).calibration_error, 0.02);
  EXPECT_GT(measure_quality(stops, too_sure).calibration_error, 0.15);
}

TEST(LostCalibrationTest, KidnapsCountWhileTheRobotIsLostAndAlarmsWithinTwoObservations) {
  const LostModel alarm_below_zero{0.0, {-100.0, 0.0, 0.0, 0.0, 0.0}};
  const auto stop = [](int since, double error_m, double advantage) {
    LostStop made;
    made.since_kidnap = since;
    made.error_m = error_m;
    made.features.advantage = advantage;
    return made;
  };
  const std::vector<LostStop> stops{stop(0, 0.1, 0.5),
                                    stop(1, 4.0, 0.5),
                                    stop(2, 4.0, -0.5),  // flagged at the second
                                    stop(3, 4.0, -0.5),
                                    stop(0, 0.1, -0.5),  // a false alarm
                                    stop(1, 4.0, 0.5),
                                    stop(2, 4.0, 0.5),  // missed
                                    stop(1, 4.0, -0.5),
                                    stop(2, 0.1, 0.5)};  // found itself: no kidnap to flag
  const LostQuality quality = measure_quality(stops, alarm_below_zero);
  EXPECT_EQ(quality.kidnaps, 2U);
  EXPECT_EQ(quality.flagged, 1U);
  EXPECT_EQ(quality.good, 3U);
  EXPECT_EQ(quality.false_alarms, 1U);
  EXPECT_EQ(quality.lost, 6U);
}

TEST(LostCalibrationTest, DiagramAndTableHoldEveryBinAndStop) {
  const LostModel model{0.0, {-2.0, 0.0, 0.0, 0.0, 0.0}};
  const std::vector<LostStop> stops = stops_of(model, 500);
  const std::string svg = reliability_svg(measure_quality(stops, model), "title");
  EXPECT_NE(svg.find(">title</text>"), std::string::npos);
  EXPECT_NE(svg.find("500 stops"), std::string::npos);
  const std::string csv = lost_stops_csv(stops, model);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 501);
}

}  // namespace
}  // namespace semview::paper2017
