// SPDX-License-Identifier: Apache-2.0
#include "semview/protocol/model_wire.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace semview::protocol {
namespace {

TEST(ModelWireTest, EachModelComesBackAsItself) {
  for (const auto& [model, unused] : kScoreModels) EXPECT_EQ(*from_wire(to_wire(model)), model);
}

TEST(ModelWireTest, WhoNamesNoModelMeansViews) {
  EXPECT_EQ(*from_wire(v1::MODEL_UNSPECIFIED), ScoreModel::kViews);
}

TEST(ModelWireTest, AModelThatNobodyKnowsIsRefused) {
  EXPECT_EQ(from_wire(static_cast<v1::Model>(77)).error().field, "model");
}

TEST(ModelWireTest, SettingsComeBackAsTheyWere) {
  const DepthScoring scoring{ScoreModel::kSem, 0.25, 1.5, 0.7, true};
  v1::DepthScoring wire;
  to_wire(scoring, &wire);
  EXPECT_EQ(*from_wire(wire, ScoreModel::kSem), scoring);
}

TEST(ModelWireTest, AbsentSettingsAreThoseOfThePaper) {
  EXPECT_EQ(*from_wire(v1::DepthScoring(), ScoreModel::kSdfSem), DepthScoring());
}

TEST(ModelWireTest, SettingsOutOfRangeAreNamed) {
  v1::DepthScoring wire;
  wire.set_z_sdf(1.1);
  EXPECT_EQ(from_wire(wire, ScoreModel::kSdf).error().field, "scoring.z_sdf");
  wire.set_z_sdf(0.0);
  wire.set_sigma_sdf_m(0.0);
  EXPECT_EQ(from_wire(wire, ScoreModel::kSdf).error().field, "scoring.sigma_sdf_m");
  wire.clear_sigma_sdf_m();
  wire.set_sigma_sem_m(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(from_wire(wire, ScoreModel::kSdf).error().field, "scoring.sigma_sem_m");
}

}  // namespace
}  // namespace semview::protocol
