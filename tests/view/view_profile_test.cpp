// SPDX-License-Identifier: Apache-2.0
#include "semview/view/view_profile.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace semview {
namespace {

std::string wrong_field(const ViewProfile& profile) {
  const Status status = validate(profile);
  return status ? "" : status.error().field;
}

TEST(ViewProfileTest, TheDefaultIsValid) { EXPECT_EQ(wrong_field(ViewProfile{}), ""); }

TEST(ViewProfileTest, EachFaultNamesItsField) {
  ViewProfile profile;
  profile.camera.columns = 361;
  EXPECT_EQ(wrong_field(profile), "columns");
  profile.camera.columns = kMaxPanoramaColumns + 120;
  EXPECT_EQ(wrong_field(profile), "columns");
  profile = {};
  profile.camera.rows = 0;
  EXPECT_EQ(wrong_field(profile), "rows");
  profile = {};
  profile.camera.elevation_max_rad = profile.camera.elevation_min_rad;
  EXPECT_EQ(wrong_field(profile), "elevation");
  profile = {};
  profile.camera.elevation_min_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(wrong_field(profile), "elevation");
  profile = {};
  profile.eye_height_m = 0.0;
  EXPECT_EQ(wrong_field(profile), "eye_height_m");
  profile.eye_height_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(wrong_field(profile), "eye_height_m");
}

}  // namespace
}  // namespace semview
