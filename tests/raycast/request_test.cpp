// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "semview/raycast/panorama_renderer.hpp"
#include "semview/raycast/pinhole_renderer.hpp"
#include "semview/view/view_profile.hpp"

namespace semview::raycast {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string field(const Status& status) { return status ? "valid" : status.error().field; }

TEST(PanoramaRequestTest, NamesTheFieldAtFault) {
  EXPECT_EQ(field(validate(PanoramaRequest{})), "valid");
  EXPECT_EQ(field(validate(PanoramaRequest{{kNaN, 0, 0}, 1.2, {}, {}})), "pose");
  EXPECT_EQ(field(validate(PanoramaRequest{{0, kInfinity, 0}, 1.2, {}, {}})), "pose");
  EXPECT_EQ(field(validate(PanoramaRequest{{0, 0, kNaN}, 1.2, {}, {}})), "pose");
  EXPECT_EQ(field(validate(PanoramaRequest{{2e6, 0, 0}, 1.2, {}, {}})), "pose");
  EXPECT_EQ(field(validate(PanoramaRequest{{}, kNaN, {}, {}})), "eye_height_m");
  EXPECT_EQ(field(validate(PanoramaRequest{{}, 1.2, {0, 90, -1, 1}, {}})), "columns");
  EXPECT_EQ(field(validate(PanoramaRequest{{}, 1.2, {kMaxPanoramaColumns + 1, 90, -1, 1}, {}})),
            "columns");
  EXPECT_EQ(field(validate(PanoramaRequest{{}, 1.2, {360, kMaxPanoramaRows + 1, -1, 1}, {}})),
            "rows");
  EXPECT_EQ(field(validate(PanoramaRequest{{}, 1.2, {360, 90, 0.5, 0.5}, {}})), "elevation");
  EXPECT_EQ(field(validate(PanoramaRequest{{}, 1.2, {360, 90, -1.6, 1}, {}})), "elevation");
  EXPECT_EQ(field(validate(PanoramaRequest{{}, 1.2, {360, 90, -1, kNaN}, {}})), "elevation");
  EXPECT_EQ(field(validate(PanoramaRequest{{}, 1.2, {}, {0.1, 1, 0}})), "affine");
  EXPECT_EQ(field(validate(PanoramaRequest{{}, 1.2, {}, {1, kNaN, 0}})), "affine");
  EXPECT_EQ(field(validate(PanoramaRequest{{}, 1.2, {}, {1, 1, -2.1}})), "affine");
}

TEST(PinholeRequestTest, NamesTheFieldAtFault) {
  const PinholeRequest good{level_camera({1, 2, 0.3}, 1.2), {}};
  EXPECT_EQ(field(validate(good)), "valid");
  PinholeRequest bad = good;
  bad.map_from_camera.translation().x() = kNaN;
  EXPECT_EQ(field(validate(bad)), "pose");
  bad = good;
  bad.map_from_camera.linear() *= 1.01;
  EXPECT_EQ(field(validate(bad)), "pose");
  bad = good;
  bad.map_from_camera.linear().col(0) *= -1.0;
  EXPECT_EQ(field(validate(bad)), "pose");
  bad = good;
  bad.camera.columns = kMaxPinholeColumns + 1;
  EXPECT_EQ(field(validate(bad)), "columns");
  bad = good;
  bad.camera.rows = 0;
  EXPECT_EQ(field(validate(bad)), "rows");
  bad = good;
  bad.camera.fx_px = 0.0;
  EXPECT_EQ(field(validate(bad)), "pinhole");
  bad = good;
  bad.camera.cy_px = kInfinity;
  EXPECT_EQ(field(validate(bad)), "pinhole");
}

}  // namespace
}  // namespace semview::raycast
