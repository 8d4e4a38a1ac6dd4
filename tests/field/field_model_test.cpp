// SPDX-License-Identifier: Apache-2.0
#include "semview/field/field_model.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace semview::field {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

TEST(FieldModelTest, TheDefaultsAreThePapers) {
  const FieldModelConfig config;
  ASSERT_TRUE(validate(config, 3).has_value());
  EXPECT_EQ(config.sigma_sdf_m, 2.0);
  EXPECT_EQ(config.sigma_sem_m, 1.5);
  const CueWeights weights = cue_weights(config, 1);
  EXPECT_EQ(weights.z_sdf, 0.5);
  EXPECT_EQ(weights.z_sem, 0.5);
}

TEST(FieldModelTest, APixelsLossIsEquationThree) {
  const FieldModelConfig config;
  for (const double z_sdf : {0.3, 0.5, 1e-7, 1.0 - 1e-7}) {
    const PixelLoss loss(config, {z_sdf, 1.0 - z_sdf});
    for (double sdf = 0.0; sdf < 8.0; sdf += 0.073) {
      for (double s = 0.0; s < 6.0; s += 0.047) {
        const double p = z_sdf * std::exp(-sdf * sdf / (2 * 2.0 * 2.0)) +
                         (1.0 - z_sdf) * std::exp(-s * s / (2 * 1.5 * 1.5));
        const int units = loss(static_cast<float>(sdf * sdf), static_cast<float>(s * s));
        ASSERT_NEAR(units, -std::log(p) * kUnitsPerNat, 2.0) << z_sdf << ' ' << sdf << ' ' << s;
      }
    }
  }
}

TEST(FieldModelTest, AnOutlierCostsNoMoreThanItsShare) {
  FieldModelConfig config;
  config.outlier = 0.1;
  ASSERT_TRUE(validate(config, 3).has_value());
  const PixelLoss sem(config, {0.0, 1.0});
  for (double s = 0.0; s < 6.0; s += 0.047) {
    const double p = 0.1 + 0.9 * std::exp(-s * s / (2 * 1.5 * 1.5));
    ASSERT_NEAR(sem(0.0F, static_cast<float>(s * s)), -std::log(p) * kUnitsPerNat, 2.0) << s;
  }
  EXPECT_NEAR(sem(0.0F, kFar), -std::log(0.1 + 0.9 * std::exp(-8.0)) * kUnitsPerNat, 2.0);
  for (const double share : {-0.1, 1.0, std::nan("")}) {
    config.outlier = share;
    ASSERT_FALSE(validate(config, 3).has_value());
    EXPECT_EQ(validate(config, 3).error().field, "outlier");
  }
}

TEST(FieldModelTest, OneCueAloneIgnoresTheOtherDistance) {
  const FieldModelConfig config;
  EXPECT_EQ(PixelLoss(config, {1.0, 0.0})(1.0F, kFar), kUnitsPerNat / 8);
  EXPECT_EQ(PixelLoss(config, {0.0, 1.0})(kFar, 9.0F), kUnitsPerNat * 2);
}

TEST(FieldModelTest, NoDistanceCountsAsMoreThanFourSigma) {
  const FieldModelConfig config;
  const PixelLoss sdf(config, {1.0, 0.0});
  EXPECT_EQ(sdf(64.0F, 0.0F), kMaxLoss_units);
  EXPECT_EQ(sdf(kFar, 0.0F), kMaxLoss_units);
  EXPECT_EQ(PixelLoss(config, {0.0, 1.0})(0.0F, kFar), kMaxLoss_units);
  const PixelLoss both(config, {0.5, 0.5});
  EXPECT_NEAR(both(kFar, kFar), kMaxLoss_units, 2);
  EXPECT_EQ(both(0.0F, 0.0F), 0);
}

TEST(FieldModelTest, AMovableClassIsTrustedByItsClassRatherThanItsPlace) {
  FieldModelConfig config;
  config.movable = {0.0, 0.8};
  EXPECT_EQ(cue_weights(config, 1).z_sem, 0.0);
  EXPECT_EQ(cue_weights(config, 2).z_sem, 0.8);
  EXPECT_DOUBLE_EQ(cue_weights(config, 2).z_sdf, 0.2);
  EXPECT_EQ(cue_weights(config, kNoHit).z_sem, 0.5);
  config.cue = FieldCue::kSdf;
  EXPECT_EQ(cue_weights(config, 2).z_sem, 0.0);
  config.cue = FieldCue::kSem;
  EXPECT_EQ(cue_weights(config, 1).z_sem, 1.0);
}

TEST(FieldModelTest, APixelOfUnknownClassUsesPSdfAlone) {
  EXPECT_EQ(cue_weights({}, kUnknown).z_sdf, 1.0);
  EXPECT_EQ(cue_weights({}, kUnknown).z_sem, 0.0);
}

TEST(FieldModelTest, WhatIsOutOfRangeIsNamed) {
  const auto field_at_fault = [](const FieldModelConfig& config) {
    const Status status = validate(config, 2);
    return status ? std::string("none") : status.error().field;
  };
  const double nan = std::nan("");
  EXPECT_EQ(field_at_fault({}), "none");
  EXPECT_EQ(field_at_fault({.z_sdf = 0.4}), "z_sdf");
  EXPECT_EQ(field_at_fault({.z_sdf = 1.5, .z_sem = -0.5}), "z_sdf");
  EXPECT_EQ(field_at_fault({.z_sdf = nan, .z_sem = nan}), "z_sdf");
  EXPECT_EQ(field_at_fault({.sigma_sdf_m = 0.0}), "sigma_sdf");
  EXPECT_EQ(field_at_fault({.sigma_sem_m = nan}), "sigma_sem");
  EXPECT_EQ(field_at_fault({.movable = {0.5}}), "movable");
  EXPECT_EQ(field_at_fault({.movable = {0.5, 1.1}}), "movable");
  EXPECT_EQ(field_at_fault({.effective_pixels = 0.0}), "effective_pixels");
  EXPECT_EQ(field_at_fault({.effective_pixels = std::nullopt}), "none");
}

}  // namespace
}  // namespace semview::field
