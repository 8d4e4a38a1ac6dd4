// SPDX-License-Identifier: Apache-2.0
// A box room has a closed form: the nearest of six planes. Every pixel is compared.
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "raycast/small_worlds.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/raycast/pinhole_renderer.hpp"

namespace semview::raycast {
namespace {

const Eigen::Vector3f kLow(-1.5F, -2.25F, 0.0F);
const Eigen::Vector3f kHigh(4.0F, 3.5F, 2.75F);

struct PlaneHit {
  ClassId label = kNoHit;
  double parameter = std::numeric_limits<double>::infinity();
  double steepness = 1.0;  // part of the direction across the plane

  /// What rounding the eye and the ray to float can move the hit by: a grazing ray magnifies it.
  double tolerance() const { return 1e-6 / steepness + 1e-6 * parameter; }
};

/// Where a ray leaves the box; `eye` is inside.
PlaneHit leave_box(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) {
  constexpr std::array<std::array<ClassId, 2>, 3> kFaces{
      {{kWest, kEast}, {kSouth, kNorth}, {kFloor, kCeiling}}};
  PlaneHit nearest;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) continue;
    const bool up = direction[axis] > 0.0;
    const double plane = static_cast<double>(up ? kHigh[axis] : kLow[axis]);
    const double t = (plane - eye[axis]) / direction[axis];
    if (t < nearest.parameter) {
      nearest = {kFaces[static_cast<std::size_t>(axis)][up ? 1 : 0], t, std::abs(direction[axis])};
    }
  }
  return nearest;
}

void expect_closed_form(const Scene& scene, const PanoramaRequest& request) {
  ASSERT_TRUE(validate(request)) << validate(request).error().message;
  const Panorama panorama = render_panorama(scene, request);
  const Eigen::Vector3d eye(
      request.map_from_robot.x_m, request.map_from_robot.y_m, request.eye_z_m);
  const Eigen::AngleAxisd yaw(request.map_from_robot.yaw_rad, Eigen::Vector3d::UnitZ());
  for (int r = 0; r < request.camera.rows; ++r) {
    for (int c = 0; c < request.camera.columns; ++c) {
      const Eigen::Vector3d direction = request.affine.apply(yaw * request.camera.direction(r, c));
      const PlaneHit truth = leave_box(eye, direction);
      ASSERT_EQ(panorama.labels.at(r, c), truth.label) << "row " << r << " column " << c;
      ASSERT_NEAR(panorama.ranges_m.at(r, c), truth.parameter, truth.tolerance())
          << "row " << r << " column " << c;
    }
  }
}

Scene box() { return std::move(*Scene::build(box_room(kLow, kHigh))); }

TEST(BoxRoomTest, EveryPixelOfAPanoramaIsTheClosedForm) {
  const Scene scene = box();
  expect_closed_form(scene, {{0.123, 0.456, 0.789}, 1.2, {}, {}});
  expect_closed_form(scene, {{-1.2, 3.1, -2.5}, 0.3, {720, 180, -1.2, 0.9}, {}});
  expect_closed_form(scene, {{3.97, -2.21, 3.0}, 2.71, {120, 40, -kPi / 2.0, kPi / 2.0}, {}});
}

TEST(BoxRoomTest, ImagesThatAreNoMultipleOfAPacketHaveEveryPixelToo) {
  const Scene scene = box();
  for (int columns = 1; columns <= 9; ++columns) {
    for (int rows = 1; rows <= 9; ++rows) {
      expect_closed_form(scene, {{0.31, 0.17, 0.2}, 1.1, {columns, rows, -0.7, 0.8}, {}});
    }
  }
}

TEST(BoxRoomTest, AffineRaysMeetTheClosedForm) {
  const Scene scene = box();
  expect_closed_form(scene, {{0.123, 0.456, 0.789}, 1.2, {}, {1.3, 0.8, 0.0}});
  expect_closed_form(scene, {{0.123, 0.456, 0.789}, 1.2, {}, {0.9, 1.1, 0.25}});
}

TEST(BoxRoomTest, RangesThroughAScaledPlanAreThoseOfTheTrueRoom) {
  // The room as drawn is 1.5 times too long in x and half as wide in y as the true one.
  const MapAffine affine{1.5, 0.5, 0.0};
  const Eigen::Vector3f scale(1.0F / 1.5F, 1.0F / 0.5F, 1.0F);
  const auto true_room =
      Scene::build(box_room(kLow.cwiseProduct(scale), kHigh.cwiseProduct(scale)));
  const Pose2 true_pose{0.4, -0.7, 0.6};
  const Pose2 drawn_pose{0.4 * 1.5, -0.7 * 0.5, 0.6};
  const Panorama drawn = render_panorama(box(), {drawn_pose, 1.2, {}, affine});
  const Panorama truth = render_panorama(*true_room, {true_pose, 1.2, {}, {}});
  EXPECT_EQ(drawn.labels, truth.labels);
  for (std::size_t i = 0; i < drawn.ranges_m.pixels().size(); ++i) {
    ASSERT_NEAR(drawn.ranges_m.pixels()[i], truth.ranges_m.pixels()[i], 2e-5);
  }
}

TEST(BoxRoomTest, EveryPixelOfAPinholeViewIsTheClosedForm) {
  const Scene scene = box();
  const PinholeRequest request{level_camera({0.4, -0.3, 2.2}, 1.3), {97, 61, 80.0, 82.0, 47.5, 29}};
  ASSERT_TRUE(validate(request));
  const PinholeView view = render_pinhole(scene, request);
  for (int r = 0; r < request.camera.rows; ++r) {
    for (int c = 0; c < request.camera.columns; ++c) {
      const Eigen::Vector3d direction =
          request.map_from_camera.linear() * request.camera.direction(r, c);
      const PlaneHit truth = leave_box(request.map_from_camera.translation(), direction);
      ASSERT_EQ(view.labels.at(r, c), truth.label) << "row " << r << " column " << c;
      ASSERT_NEAR(view.depths_m.at(r, c), truth.parameter, truth.tolerance());
    }
  }
}

TEST(BoxRoomTest, RaysThatMeetNothingAreZeroAndInfinite) {
  const Panorama panorama = render_panorama(box(), {{50.0, 0.0, 0.0}, 1.2, {}, {}});
  // The room lies straight behind: in the image's left and right edges.
  EXPECT_EQ(panorama.labels.at(45, 180), kNoHit);
  EXPECT_EQ(panorama.ranges_m.at(45, 180), std::numeric_limits<float>::infinity());
  EXPECT_EQ(panorama.labels.at(45, 0), kEast);
  EXPECT_NEAR(panorama.ranges_m.at(45, 0), 46.0F, 0.01F);
}

TEST(BoxRoomTest, AnEyeExactlyOnAFaceSeesItAtRangeZeroAndTheRoomTheOtherWay) {
  const Scene scene = box();
  // Exactly on the wall, and a rounding error on either side of it.
  for (const double x : {4.0, 3.9999999, 4.0000005}) {
    const Panorama panorama = render_panorama(scene, {{x, 0.5, 0.0}, 1.2, {}, {}});
    for (int r = 0; r < 90; ++r) {
      for (int c = 0; c < 360; ++c) {
        const float range_m = panorama.ranges_m.at(r, c);
        ASSERT_TRUE(std::isfinite(range_m)) << "row " << r << " column " << c;
        if (c >= 90 && c < 270) {
          ASSERT_EQ(panorama.labels.at(r, c), kEast) << "row " << r << " column " << c;
          ASSERT_NEAR(range_m, 0.0, 1e-4);
        } else {
          ASSERT_NE(panorama.labels.at(r, c), kEast) << "row " << r << " column " << c;
          ASSERT_GT(range_m, 0.5);
        }
      }
    }
  }
}

TEST(BoxRoomTest, AnEyeInACornerOfThreeFacesSeesTheRoomAndNothingUndefined) {
  const Scene scene = box();
  const PanoramaCamera all_around{360, 180, -kPi / 2.0, kPi / 2.0};
  const PanoramaRequest request{{-1.5, -2.25, 0.0}, 0.0, all_around, {}};
  const Panorama panorama = render_panorama(scene, request);
  for (const float range_m : panorama.ranges_m.pixels()) {
    ASSERT_FALSE(std::isnan(range_m));
    ASSERT_GE(range_m, 0.0F);
  }
  // Up and to the north-east: the far faces.
  const ClassId seen = panorama.labels.at(60, 135);
  EXPECT_TRUE(seen == kCeiling || seen == kEast || seen == kNorth);
  EXPECT_EQ(panorama.labels, render_panorama_single_rays(scene, request).labels);
}

TEST(BoxRoomTest, ColumnViewsAreTheLabelsOfThePanorama) {
  const Scene scene = box();
  const PanoramaRequest request{{0.3, 0.2, 0.1}, 1.2, {}, {}};
  EXPECT_EQ(render_column_view(scene, request),
            ColumnView::from_labels(render_panorama(scene, request).labels));
}

TEST(BoxRoomTest, AHeadingOfTheGridIsAShiftOfColumns) {
  const Scene scene = box();
  for (const int columns : {120, 360, 720}) {
    const PanoramaCamera camera{columns, 90, -kPi / 4.0, kPi / 4.0};
    const Pose2 pose{0.37, 0.91, 0.0};
    const ColumnView ahead = render_column_view(scene, {pose, 1.2, camera, {1.1, 0.9, 0.1}});
    for (int heading = 0; heading < PoseGrid::kHeadings; ++heading) {
      const Pose2 turned{pose.x_m, pose.y_m, PoseGrid::heading_yaw_rad(heading)};
      const Panorama panorama = render_panorama(scene, {turned, 1.2, camera, {1.1, 0.9, 0.1}});
      ASSERT_EQ(panorama.labels, ahead.to_labels(heading)) << "heading " << heading;
    }
  }
}

}  // namespace
}  // namespace semview::raycast
