// SPDX-License-Identifier: Apache-2.0
#include "semview/segmentation/camera_rig.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace semview::segmentation {
namespace {

using semview::testing::TemporaryFolder;
using ::testing::HasSubstr;

const std::string kPinhole =
    "    pinhole: {width: 640, height: 480, fx: 500, fy: 501, cx: 320, cy: 240}\n";

Result<CameraRig> read(const std::string& yaml) {
  const TemporaryFolder folder;
  return read_camera_rig(folder.write("rig.yaml", yaml));
}

std::string error_of(const std::string& cameras) {
  const auto rig = read("format: 1\ncameras:\n" + cameras);
  return rig ? "no error" : rig.error().message;
}

TEST(CameraRigTest, EveryKindOfCameraIsRead) {
  const Result<CameraRig> rig =
      read("format: 1\ncameras:\n  - name: left\n" + kPinhole +
           "    distortion: {model: plumb_bob, coefficients: [-0.3, 0.1, 0.001, 0.002, 0]}\n"
           "    base_from_camera: {x: 0.1, z: 1.0, yaw_deg: 30}\n"
           "  -\n" +
           kPinhole +
           "    distortion: {model: equidistant, coefficients: [0.01, 0, 0, 0]}\n"
           "    base_from_camera: {x: 0.3, z: 1.4}\n"
           "  - equirectangular: {elevation_min_deg: -90, elevation_max_deg: 90}\n"
           "    base_from_camera: {x: 0.2, z: 1.2, roll_deg: 3}\n");
  ASSERT_TRUE(rig) << rig.error().message;
  ASSERT_EQ(rig->cameras.size(), 3U);
  EXPECT_EQ(rig->cameras[0].name, "left");
  const auto& left = std::get<LensCamera>(rig->cameras[0].camera);
  EXPECT_EQ(left.pinhole.fy_px, 501.0);
  EXPECT_EQ(left.lens, *Lens::make(Lens::Model::kPlumbBob, {-0.3, 0.1, 0.001, 0.002, 0.0}));
  EXPECT_TRUE(left.base_from_camera.isApprox(level_camera({0.1, 0.0, rad_from_deg(30.0)}, 1.0)));
  EXPECT_EQ(rig->cameras[1].name, "camera 2");
  EXPECT_EQ(std::get<LensCamera>(rig->cameras[1].camera).lens.model(), Lens::Model::kEquidistant);
  EXPECT_TRUE(std::holds_alternative<EquirectangularCamera>(rig->cameras[2].camera));
  EXPECT_TRUE(rig->eye_m().isApprox(Eigen::Vector3d(0.2, 0.0, 1.2)));
}

TEST(CameraRigTest, FaultsNameFileAndLine) {
  EXPECT_EQ(error_of("  -\n" + kPinhole), "no error");
  EXPECT_THAT(read("format: 3\ncameras: []\n").error().message,
              HasSubstr("rig.yaml:1: format 3, this version reads 1"));
  EXPECT_THAT(error_of("  []\n"), HasSubstr("0 cameras, expected 1 to 64"));
  EXPECT_THAT(error_of("  - name: a\n"), HasSubstr("rig.yaml:3: expected either 'pinhole' or"));
  EXPECT_THAT(error_of("  -\n" + kPinhole + "    distortion: {model: brown}\n"),
              HasSubstr("rig.yaml:5: distortion 'brown', expected none, plumb_bob or equidistant"));
  EXPECT_THAT(error_of("  -\n" + kPinhole +
                       "    distortion: {model: equidistant, coefficients: [1, 2, 3]}\n"),
              HasSubstr("rig.yaml:5"));
  EXPECT_THAT(error_of("  -\n" + kPinhole + "    distortion: {model: plumb_bob}\n"),
              HasSubstr("'coefficients' is missing"));
  EXPECT_THAT(error_of("  - equirectangular: {elevation_min_deg: -90, elevation_max_deg: 90}\n"
                       "    distortion: {model: none}\n"),
              HasSubstr("no distortion"));
  const auto with_fx = [](const std::string& fx) {
    return "  - pinhole: {width: 640, height: 480, fx: " + fx + ", fy: 500, cx: 320, cy: 240}\n";
  };
  EXPECT_EQ(error_of(with_fx("500")), "no error");
  EXPECT_THAT(error_of(with_fx("1e-9")),
              HasSubstr("rig.yaml:3: fx 1e-09 px gives 640 px no field of view, expected 6.4 to"));
  EXPECT_THAT(error_of(with_fx("1e9")), HasSubstr("fx 1e+09 px"));
  EXPECT_THAT(error_of("  -\n" + kPinhole + "    yaw: 3\n"), HasSubstr("unknown key"));
}

TEST(CameraRigTest, TheCameraOfARunLogIsARigToo) {
  MountedPinhole mounted;
  mounted.camera.columns = 10;
  const CameraRig pinhole = rig_of(mounted);
  EXPECT_EQ(columns_of(pinhole.cameras.front().camera), 10);
  PartialPanorama panorama;
  panorama.position_m = {0.1, 0.2, 0.9};
  const CameraRig whole = rig_of(panorama);
  EXPECT_TRUE(whole.eye_m().isApprox(panorama.position_m));
  EXPECT_TRUE(of_size(whole.cameras.front().camera, 50, 100));
  EXPECT_THAT(of_size(pinhole.cameras.front().camera, 50, 100).error().message,
              HasSubstr("100 x 50 pixels, expected the camera's 10 x 480"));
}

}  // namespace
}  // namespace semview::segmentation
