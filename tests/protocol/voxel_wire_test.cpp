// SPDX-License-Identifier: Apache-2.0
#include "semview/protocol/voxel_wire.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace semview::protocol {
namespace {

ClassTable two_classes() { return ClassTable({"wall", "floor"}); }

VoxelList small_list() {
  return {two_classes(),
          0.05,
          {{-3, 2, 0, 1, 7},
           {0, 0, 30, 1, 1},
           {std::int16_t{-32768}, 32767, 1, 2, 40000},
           {9, 9, 9, kUnknown, 2}},
          12.5};
}

DepthObservation small_image() {
  DepthObservation seen;
  seen.classes = two_classes();
  seen.stamp_s = 12.5;
  seen.camera = {3, 2, 2.5, 2.25, 1.5, 1.125};
  seen.depth_m = Image<float>(2, 3, 1.234F);
  seen.depth_m.at(0, 1) = 65.535F;
  seen.depth_m.at(1, 2) = 0.0F;
  seen.labels = LabelImage(2, 3, 2);
  seen.labels.at(1, 0) = kUnknown;
  seen.base_from_camera.translate(Eigen::Vector3d(0.1, -0.2, 1.3));
  seen.base_from_camera.rotate(Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, -2, 3).normalized()));
  return seen;
}

template <typename Message, typename Thing>
Message sent(const Thing& thing) {
  Message wire;
  to_wire(thing, &wire);
  return wire;
}

/// The field that is blamed for a change to a good message; empty: none.
template <typename Message, typename Thing>
std::string blamed(const Thing& thing, const std::function<void(Message&)>& change) {
  auto wire = sent<Message>(thing);
  change(wire);
  const auto back = from_wire(wire, two_classes(), 0.0);
  return back ? "" : back.error().field;
}

std::string blamed_in_list(const std::function<void(v1::VoxelList&)>& change) {
  return blamed<v1::VoxelList>(small_list(), change);
}

std::string blamed_in_image(const std::function<void(v1::DepthImage&)>& change) {
  return blamed<v1::DepthImage>(small_image(), change);
}

TEST(VoxelWireTest, AListOfVoxelsComesBackAsItWas) {
  const auto back = from_wire(sent<v1::VoxelList>(small_list()), two_classes(), 12.5);
  ASSERT_TRUE(back.has_value()) << back.error().message;
  EXPECT_EQ(*back, small_list());
}

TEST(VoxelWireTest, AListsWrongFieldIsNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(blamed_in_list([](auto&) {}), "");
  EXPECT_EQ(blamed_in_list([](auto& wire) { wire.Clear(); }), "voxels.voxel_m");
  EXPECT_EQ(blamed_in_list([nan](auto& wire) { wire.set_voxel_m(nan); }), "voxels.voxel_m");
  EXPECT_EQ(blamed_in_list([](auto& wire) { wire.set_voxel_m(1.01); }), "voxels.voxel_m");
  EXPECT_EQ(blamed_in_list([](auto& wire) { wire.add_z(1); }), "voxels");
  EXPECT_EQ(blamed_in_list([](auto& wire) { wire.set_labels(""); }), "voxels");
  EXPECT_EQ(blamed_in_list([](auto& wire) { wire.set_x(0, 32768); }), "voxels.x");
  EXPECT_EQ(blamed_in_list([](auto& wire) { wire.set_y(0, -32769); }), "voxels.y");
  EXPECT_EQ(blamed_in_list([](auto& wire) { (*wire.mutable_labels())[3] = 3; }), "voxels.labels");
  EXPECT_EQ(blamed_in_list([](auto& wire) { (*wire.mutable_labels())[0] = 0; }), "voxels.labels");
  EXPECT_EQ(blamed_in_list([](auto& wire) { wire.set_counts(1, 0); }), "voxels.counts");
  EXPECT_EQ(blamed_in_list([](auto& wire) { wire.set_counts(1, kMaxVoxelPixels); }),
            "voxels.counts");
}

TEST(VoxelWireTest, VoxelsComeInOrderAndOnce) {
  EXPECT_EQ(blamed_in_list([](auto& wire) { wire.set_z(1, -1); }), "voxels");
  EXPECT_EQ(blamed_in_list([](auto& wire) {
              wire.set_x(1, -3);
              wire.set_y(1, 2);
              wire.set_z(1, 0);
            }),
            "voxels");
}

TEST(VoxelWireTest, AnImageInMillimetresComesBackAsItWas) {
  const DepthObservation seen = small_image();
  const auto back = from_wire(sent<v1::DepthImage>(seen), two_classes(), 12.5);
  ASSERT_TRUE(back.has_value()) << back.error().message;
  EXPECT_EQ(back->classes, seen.classes);
  EXPECT_EQ(back->stamp_s, 12.5);
  EXPECT_EQ(back->camera, seen.camera);
  EXPECT_EQ(back->depth_m, seen.depth_m);
  EXPECT_EQ(back->labels, seen.labels);
  EXPECT_EQ(back->base_from_camera.matrix(), seen.base_from_camera.matrix());  // to the last bit
}

TEST(VoxelWireTest, AnImageWithoutLabelsHasNone) {
  DepthObservation seen = small_image();
  seen.labels = {};
  EXPECT_TRUE(from_wire(sent<v1::DepthImage>(seen), two_classes(), 0.0)->labels.empty());
}

TEST(VoxelWireTest, ADepthThatMillimetresCannotHoldWasNotMeasured) {
  DepthObservation seen = small_image();
  seen.depth_m.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
  seen.depth_m.at(0, 1) = 66.0F;
  seen.depth_m.at(0, 2) = -1.0F;
  seen.depth_m.at(1, 0) = std::numeric_limits<float>::infinity();
  const auto back = from_wire(sent<v1::DepthImage>(seen), two_classes(), 0.0);
  for (int column = 0; column < 3; ++column) EXPECT_EQ(back->depth_m.at(0, column), 0.0F);
  EXPECT_EQ(back->depth_m.at(1, 0), 0.0F);
  EXPECT_EQ(back->depth_m.at(1, 1), 1.234F);
}

TEST(VoxelWireTest, AnImagesWrongFieldIsNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(blamed_in_image([](auto&) {}), "");
  EXPECT_EQ(blamed_in_image([](auto& wire) { wire.Clear(); }), "depth.columns");
  EXPECT_EQ(blamed_in_image([](auto& wire) { wire.set_rows(5000); }), "depth.rows");
  EXPECT_EQ(blamed_in_image([nan](auto& wire) { wire.set_fx_px(nan); }), "depth.fx_px");
  EXPECT_EQ(blamed_in_image([](auto& wire) { wire.set_depth_mm("xy"); }), "depth.depth_mm");
  EXPECT_EQ(blamed_in_image([](auto& wire) { wire.set_labels("xy"); }), "depth.labels");
  EXPECT_EQ(blamed_in_image([](auto& wire) { wire.add_base_from_camera(0.0); }),
            "depth.base_from_camera");
  EXPECT_EQ(blamed_in_image([](auto& wire) { wire.set_base_from_camera(0, 2.0); }),
            "depth.base_from_camera");
  EXPECT_EQ(blamed_in_image([nan](auto& wire) { wire.set_base_from_camera(3, nan); }),
            "depth.base_from_camera");
  EXPECT_EQ(blamed_in_image([](auto& wire) {
              for (int i = 0; i < 4; ++i) wire.set_base_from_camera(i, -wire.base_from_camera(i));
            }),
            "depth.base_from_camera");  // mirrored
}

}  // namespace
}  // namespace semview::protocol
