// SPDX-License-Identifier: Apache-2.0
// Cameras of all kinds look into a known scene through the product's renderer; what is stitched of
// their pictures is compared with the panorama of the same renderer.
#include "semview/segmentation/stitching.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "raycast/small_worlds.hpp"
#include "semview/io/camera_yaml.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/raycast/pinhole_renderer.hpp"
#include "semview/raycast/scene.hpp"
#include "semview/segmentation/crops.hpp"
#include "semview/segmentation/panorama_observer.hpp"

namespace semview::segmentation {
namespace {

const PanoramaCamera kSphere{360, 180, -kPi / 2.0, kPi / 2.0};
const Pose2 kPose{0.7, -0.4, 0.9};
constexpr double kEye_m = 1.3;

/// A box room with a table and a cupboard in it.
const raycast::Scene& scene() {
  static const raycast::Scene built = [] {
    map::TriangleMesh room = raycast::box_room({-2.0F, -3.0F, 0.0F}, {4.0F, 2.5F, 2.6F});
    raycast::add_quad(
        room, {{1.0F, 0.5F, 0.7F}, {2.5F, 0.5F, 0.7F}, {2.5F, 1.8F, 0.7F}, {1.0F, 1.8F, 0.7F}}, 7);
    raycast::add_quad(
        room,
        {{-1.0F, -2.0F, 0.0F}, {0.5F, -2.0F, 0.0F}, {0.5F, -2.0F, 1.9F}, {-1.0F, -2.0F, 1.9F}},
        8);
    return std::move(*raycast::Scene::build(room));
  }();
  return built;
}

LabelImage true_panorama() {
  return raycast::render_panorama(scene(), {kPose, kEye_m, kSphere}).labels;
}

Segmentation sure(LabelImage labels) {
  Image<std::uint8_t> confidence(labels.rows(), labels.columns(), 255);
  return {std::move(labels), std::move(confidence)};
}

io::CameraMount mount(double roll_deg, double pitch_deg, double yaw_deg) {
  return {{0.0, 0.0, 0.0}, rad_from_deg(roll_deg), rad_from_deg(pitch_deg), rad_from_deg(yaw_deg)};
}

/// A camera of `width_deg` x `height_deg` without distortion.
LensCamera pinhole(
    int columns, int rows, double width_deg, double height_deg, const io::CameraMount& mounted) {
  LensCamera camera;
  camera.pinhole = {columns,
                    rows,
                    columns / 2.0 / std::tan(rad_from_deg(width_deg / 2.0)),
                    rows / 2.0 / std::tan(rad_from_deg(height_deg / 2.0)),
                    columns / 2.0,
                    rows / 2.0};
  camera.base_from_camera = io::base_from_optical(mounted);
  return camera;
}

/// What `camera` sees: every pixel's own ray, through its lens, looked up in a fine picture that
/// the renderer made of the same view without distortion.
SegmentedImage taken(const LensCamera& camera) {
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  map_from_base.linear() =
      Eigen::AngleAxisd(kPose.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  map_from_base.translation() << kPose.x_m, kPose.y_m, kEye_m;
  const Eigen::Isometry3d map_from_camera = map_from_base * camera.base_from_camera;
  if (camera.lens.model() == Lens::Model::kNone) {
    const auto view = raycast::render_pinhole(scene(), {map_from_camera, camera.pinhole});
    return {camera, sure(view.labels)};
  }
  const PinholeCamera fine{1200, 1200, 300.0, 300.0, 600.0, 600.0};  // 127° wide
  const auto view = raycast::render_pinhole(scene(), {map_from_camera, fine});
  LabelImage labels(camera.pinhole.rows, camera.pinhole.columns, kUnknown);
  for (int r = 0; r < labels.rows(); ++r) {
    for (int c = 0; c < labels.columns(); ++c) {
      const auto ray =
          camera.lens.unproject({(c + 0.5 - camera.pinhole.cx_px) / camera.pinhole.fx_px,
                                 (r + 0.5 - camera.pinhole.cy_px) / camera.pinhole.fy_px});
      if (!ray || ray->z() <= 0.0) continue;
      const int u = static_cast<int>(std::floor(300.0 * ray->x() / ray->z() + 600.0));
      const int v = static_cast<int>(std::floor(300.0 * ray->y() / ray->z() + 600.0));
      if (u >= 0 && u < 1200 && v >= 0 && v < 1200) labels.at(r, c) = view.labels.at(v, u);
    }
  }
  Segmentation segmentation = sure(labels);
  for (std::size_t i = 0; i < labels.pixels().size(); ++i) {
    if (labels.pixels()[i] == kUnknown) segmentation.confidence.pixels()[i] = 0;
  }
  return {camera, segmentation};
}

struct Agreement {
  double wrong_share = 0.0;  ///< of the known pixels
  double known_share = 0.0;
};

Agreement compare(const LabelImage& stitched, const LabelImage& truth) {
  double known = 0.0;
  double wrong = 0.0;
  for (std::size_t i = 0; i < truth.pixels().size(); ++i) {
    if (stitched.pixels()[i] == kUnknown) continue;
    known += 1.0;
    wrong += stitched.pixels()[i] != truth.pixels()[i] ? 1.0 : 0.0;
  }
  return {wrong / known, known / static_cast<double>(truth.pixels().size())};
}

/// The columns in which anything is known, in degrees.
double width_deg(const LabelImage& labels) {
  int columns = 0;
  for (int c = 0; c < labels.columns(); ++c) {
    int r = 0;
    while (r < labels.rows() && labels.at(r, c) == kUnknown) ++r;
    columns += r < labels.rows() ? 1 : 0;
  }
  return 360.0 * columns / labels.columns();
}

TEST(StitchingTest, SevenImagesOfThePaperMakeOnePanoramaOf268Degrees) {
  std::vector<SegmentedImage> images;
  for (int k = -3; k <= 3; ++k) {
    images.push_back(
        taken(pinhole(480, 360, 95.0, 76.0, mount(0.0, 0.0, k * (268.0 - 95.0) / 6.0))));
  }
  const Segmentation stitched = stitch(images, kSphere);
  EXPECT_NEAR(width_deg(stitched.labels), 268.0, 1.01);
  EXPECT_LT(compare(stitched.labels, true_panorama()).wrong_share, 0.004);
  // Behind the robot nothing is seen.
  EXPECT_EQ(stitched.labels.at(90, 0), kUnknown);
  EXPECT_EQ(stitched.confidence.at(90, 0), 0);
}

TEST(StitchingTest, TheCamerasRollAndPitchAreUndone) {
  const Segmentation stitched =
      stitch(std::vector{taken(pinhole(640, 480, 90.0, 70.0, mount(7.0, 12.0, 35.0))),
                         taken(pinhole(640, 480, 90.0, 70.0, mount(-5.0, -9.0, -60.0)))},
             kSphere);
  EXPECT_LT(compare(stitched.labels, true_panorama()).wrong_share, 0.004);
  EXPECT_GT(compare(stitched.labels, true_panorama()).known_share, 0.15);
}

TEST(StitchingTest, ALensDistortionIsUndone) {
  LensCamera barrel = pinhole(320, 240, 80.0, 60.0, mount(3.0, -4.0, 20.0));
  barrel.lens = *Lens::make(Lens::Model::kPlumbBob, {-0.28, 0.09, 0.001, -0.0015, -0.01});
  LensCamera fisheye = pinhole(300, 300, 90.0, 90.0, mount(0.0, 5.0, 180.0));
  fisheye.lens = *Lens::make(Lens::Model::kEquidistant, {-0.02, 0.004, -0.002, 0.0002});
  const Segmentation stitched = stitch(std::vector{taken(barrel), taken(fisheye)}, kSphere);
  EXPECT_LT(compare(stitched.labels, true_panorama()).wrong_share, 0.006);
  EXPECT_GT(compare(stitched.labels, true_panorama()).known_share, 0.2);
  // Without its lens the same picture is in the wrong place.
  SegmentedImage straightened = taken(barrel);
  std::get<LensCamera>(straightened.camera).lens = Lens();
  EXPECT_GT(compare(stitch(std::vector{straightened}, kSphere).labels, true_panorama()).wrong_share,
            0.02);
}

TEST(StitchingTest, ATiltedEquirectangularPictureIsTurnedUpright) {
  EquirectangularCamera camera;
  camera.photo.elevation_min_rad = -kPi / 2.0;
  camera.photo.elevation_max_rad = kPi / 2.0;
  camera.photo.columns = 1440;
  camera.photo.rows = 720;
  camera.base_from_camera = io::base_from_level(mount(6.0, -11.0, 70.0));
  // The picture of the tilted camera, pixel by pixel out of a fine upright one.
  const PanoramaCamera fine{3600, 1020, -kPi / 2.0, kPi / 2.0};
  const LabelImage upright = raycast::render_panorama(scene(), {kPose, kEye_m, fine}).labels;
  const PanoramaCamera own{1440, 720, -kPi / 2.0, kPi / 2.0};
  LabelImage tilted(720, 1440);
  for (int r = 0; r < 720; ++r) {
    for (int c = 0; c < 1440; ++c) {
      const Eigen::Vector3d d = camera.base_from_camera.linear() * own.direction(r, c);
      tilted.at(r, c) = upright.at(fine.row_of(std::asin(std::clamp(d.z(), -1.0, 1.0))),
                                   fine.column_of(std::atan2(d.y(), d.x())));
    }
  }
  const Segmentation stitched = stitch(std::vector{SegmentedImage{camera, sure(tilted)}}, kSphere);
  const Agreement agreement = compare(stitched.labels, true_panorama());
  EXPECT_EQ(agreement.known_share, 1.0);
  EXPECT_LT(agreement.wrong_share, 0.006);
}

/// Two cameras side by side that see the direction ahead, of one label each.
Segmentation overlap(
    ClassId left, int left_sure, ClassId right, int right_sure, double right_yaw_deg) {
  const LensCamera a = pinhole(100, 100, 90.0, 90.0, mount(0.0, 0.0, 0.0));
  const LensCamera b = pinhole(100, 100, 90.0, 90.0, mount(0.0, 0.0, right_yaw_deg));
  const auto image = [](const LensCamera& camera, ClassId label, int confidence) {
    return SegmentedImage{camera,
                          {LabelImage(100, 100, label),
                           Image<std::uint8_t>(100, 100, static_cast<std::uint8_t>(confidence))}};
  };
  return stitch(std::vector{image(a, left, left_sure), image(b, right, right_sure)}, kSphere);
}

TEST(StitchingTest, WhereImagesOverlapTheSurerOneAndTheOneFartherFromItsBorderWin) {
  const int ahead = kSphere.column_of(-0.01);
  EXPECT_EQ(overlap(1, 200, 2, 100, 0.0).labels.at(90, ahead), 1);
  EXPECT_EQ(overlap(1, 100, 2, 200, 0.0).labels.at(90, ahead), 2);
  EXPECT_EQ(overlap(1, 150, 2, 150, -40.0).labels.at(90, ahead), 1);
  const int right = kSphere.column_of(rad_from_deg(-40.0));
  EXPECT_EQ(overlap(1, 150, 2, 150, -40.0).labels.at(90, right), 2);
}

TEST(StitchingTest, ConfidenceIsThatOfTheClassInAllImagesTogether) {
  const int ahead = kSphere.column_of(-0.01);
  // Equal voices: one is sure to 200, the other saw something else.
  EXPECT_EQ(overlap(1, 200, 2, 100, 0.0).confidence.at(90, ahead), 100);
  EXPECT_EQ(overlap(1, 200, 1, 100, 0.0).confidence.at(90, ahead), 150);
  // What an image does not show has no voice in it.
  EXPECT_EQ(overlap(1, 200, kUnknown, 0, 0.0).confidence.at(90, ahead), 200);
  EXPECT_EQ(overlap(1, 200, kUnknown, 250, 0.0).labels.at(90, ahead), kUnknown);
}

TEST(CropsTest, ACropOfAnEquirectangularPhotographIsWhatAPinholeCameraSees) {
  // Labels as colours, so that the renderer tells what is right.
  const PanoramaCamera fine{1440, 720, -kPi / 2.0, kPi / 2.0};
  const LabelImage labels = raycast::render_panorama(scene(), {kPose, kEye_m, fine}).labels;
  Photo photo{equirectangular_rig(kEye_m).cameras.front().camera, RgbImage(720, 1440)};
  std::get<EquirectangularCamera>(photo.camera).photo.rows = 720;
  std::get<EquirectangularCamera>(photo.camera).photo.columns = 1440;
  for (std::size_t i = 0; i < labels.pixels().size(); ++i) {
    photo.image.pixels()[i] = {static_cast<unsigned char>(25 * labels.pixels()[i]), 0, 0};
  }
  const LensCamera camera = pinhole(200, 150, 90.0, 70.0, mount(0.0, 10.0, 50.0));
  const Crop cropped = crop(photo, camera);
  const LabelImage truth = taken(camera).segmentation.labels;
  int wrong = 0;
  for (std::size_t i = 0; i < truth.pixels().size(); ++i) {
    wrong += std::abs(cropped.photo.image.pixels()[i].r - 25 * truth.pixels()[i]) > 8 ? 1 : 0;
  }
  EXPECT_LT(wrong, static_cast<int>(truth.pixels().size()) / 50);
}

TEST(CropsTest, WidePhotographsAreCroppedAndNarrowOnesAreNot) {
  EXPECT_TRUE(is_too_wide(equirectangular_rig(1.2).cameras.front().camera));
  EXPECT_FALSE(is_too_wide(pinhole(640, 480, 95.0, 76.0, {})));
  LensCamera fisheye = pinhole(600, 600, 90.0, 90.0, {});
  fisheye.pinhole.fx_px = fisheye.pinhole.fy_px = 190.0;  // 90° off the axis at the border
  fisheye.lens = *Lens::make(Lens::Model::kEquidistant, {});
  EXPECT_TRUE(is_too_wide(fisheye));
  fisheye.pinhole.fx_px = fisheye.pinhole.fy_px = 400.0;
  EXPECT_FALSE(is_too_wide(fisheye));
}

}  // namespace
}  // namespace semview::segmentation
