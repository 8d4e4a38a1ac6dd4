// SPDX-License-Identifier: Apache-2.0
#include "semview/protocol/score_wire.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace semview::protocol {
namespace {

v1::SetObservationRequest small_observation() {
  Observation observation;
  observation.classes = ClassTable({"wall", "floor"});
  observation.labels = LabelImage(2, 3, 1);
  observation.labels.at(1, 2) = kUnknown;
  observation.stamp_s = 12.5;
  v1::SetObservationRequest wire;
  to_wire(observation, &wire);
  return wire;
}

TEST(ScoreWireTest, AnObservationComesBackAsItWas) {
  const auto back = from_wire(small_observation());
  ASSERT_TRUE(back);
  EXPECT_EQ(back->classes, ClassTable({"wall", "floor"}));
  EXPECT_EQ(back->labels.at(0, 0), 1);
  EXPECT_EQ(back->labels.at(1, 2), kUnknown);
  EXPECT_EQ(back->stamp_s, 12.5);
}

TEST(ScoreWireTest, AnObservationsWrongFieldIsNamed) {
  v1::SetObservationRequest wire = small_observation();
  wire.set_stamp_s(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(from_wire(wire).error().field, "stamp_s");
  wire = small_observation();
  wire.set_rows(3);
  EXPECT_EQ(from_wire(wire).error().field, "labels");
  wire = small_observation();
  wire.add_class_names("wall");
  EXPECT_EQ(from_wire(wire).error().field, "class_names");
  wire.clear_class_names();
  EXPECT_EQ(from_wire(wire).error().field, "class_names");
  for (int i = 0; i < 255; ++i) wire.add_class_names(std::to_string(i));
  EXPECT_EQ(from_wire(wire).error().field, "class_names");
}

TEST(ScoreWireTest, AScoreRequestComesBackAsItWas) {
  const ScoreRequest request{{{1.0, 2.0, 0.5}}, HeadingMode::kCompass, true};
  v1::ScoreRequest wire;
  to_wire(request, &wire);
  const auto back = from_wire(wire, 10);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->poses, request.poses);
  EXPECT_EQ(back->mode, request.mode);
  EXPECT_EQ(back->whole_curve, request.whole_curve);
}

TEST(ScoreWireTest, AffinesComeBackOnTheirGrid) {
  const ScoreRequest request{{{1.0, 2.0, 0.5}, {}, {}},
                             HeadingMode::kAsGiven,
                             false,
                             {{}, {1.31, 0.77, -0.3}, {5, 0.2, 2}}};
  v1::ScoreRequest wire;
  to_wire(request, &wire);
  const auto back = from_wire(wire, 10);
  ASSERT_TRUE(back) << back.error().message;
  ASSERT_EQ(back->affines.size(), 3U);
  EXPECT_TRUE(back->affines[0].is_identity());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(back->affines[i], on_affine_grid(request.affines[i]));
    EXPECT_TRUE(back->affines[i].in_range());
  }
}

TEST(ScoreWireTest, AffinesThatAreNotOneAPoseOrOutOfRangeAreRefused) {
  const ScoreRequest request{{{}, {}}, HeadingMode::kAsGiven, false, {{}, {}}};
  v1::ScoreRequest good;
  to_wire(request, &good);
  ASSERT_TRUE(from_wire(good, 10));
  v1::ScoreRequest wire = good;
  wire.mutable_affines()->add_k(0);
  EXPECT_EQ(from_wire(wire, 10).error().field, "affines");
  wire.mutable_affines()->add_a(0);
  wire.mutable_affines()->add_b(0);
  EXPECT_EQ(from_wire(wire, 10).error().field, "affines") << "three of two poses";
  wire = good;
  wire.mutable_affines()->set_a(1, 81);
  EXPECT_EQ(from_wire(wire, 10).error().field, "affines");
  wire = good;
  wire.mutable_affines()->set_k(0, -101);
  EXPECT_EQ(from_wire(wire, 10).error().field, "affines");
}

TEST(ScoreWireTest, ACurveWithoutTheCompassAndAnUnknownModeAreRefused) {
  v1::ScoreRequest wire;
  to_wire({{{1.0, 2.0, 0.5}}, HeadingMode::kAsGiven, true}, &wire);
  EXPECT_EQ(from_wire(wire, 10).error().field, "whole_curve");
  wire.set_mode(static_cast<v1::HeadingMode>(9));
  EXPECT_EQ(from_wire(wire, 10).error().field, "mode");
}

TEST(ScoreWireTest, ScoresComeBackBitForBit) {
  const ScoreRequest request{{{}, {}}, HeadingMode::kCompass, true};
  ScoreBatch batch{
      364, 9000, {-5, kNoView}, {119, 0}, std::vector<std::int32_t>(240, -7), {1, 2, 3}};
  batch.curve[17] = 123'456'789;
  const auto back = from_wire(to_wire(batch), request);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->weight_scale, batch.weight_scale);
  EXPECT_EQ(back->observed_pixels, batch.observed_pixels);
  EXPECT_EQ(back->sums, batch.sums);
  EXPECT_EQ(back->best_heading, batch.best_heading);
  EXPECT_EQ(back->curve, batch.curve);
  EXPECT_EQ(back->origins, batch.origins);
}

TEST(ScoreWireTest, AnAnswerToAnotherRequestIsDataLoss) {
  const ScoreRequest request{{{}, {}}, HeadingMode::kCompass, false};
  const ScoreBatch batch{364, 9000, {1, 2}, {0, 119}, {}, {}};
  EXPECT_TRUE(from_wire(to_wire(batch), request));
  ScoreBatch bad = batch;
  bad.sums.pop_back();
  EXPECT_EQ(from_wire(to_wire(bad), request).error().code, ErrorCode::kDataLoss);
  bad = batch;
  bad.best_heading[0] = 120;
  EXPECT_EQ(from_wire(to_wire(bad), request).error().code, ErrorCode::kDataLoss);
  bad = batch;
  bad.observed_pixels = 0;
  EXPECT_EQ(from_wire(to_wire(bad), request).error().code, ErrorCode::kDataLoss);
}

}  // namespace
}  // namespace semview::protocol
