// SPDX-License-Identifier: Apache-2.0
#include "semview/protocol/view_wire.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace semview::protocol {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

v1::Poses two_poses() {
  v1::Poses wire;
  to_wire(std::vector<Pose2>{{1.0, 2.0, 3.0}, {-4.5, 0.125, -1.0}}, &wire);
  return wire;
}

TEST(ViewWireTest, PosesComeBackBitForBit) {
  const auto poses = from_wire(two_poses(), 10, "poses");
  ASSERT_TRUE(poses);
  EXPECT_EQ(*poses, (std::vector<Pose2>{{1.0, 2.0, 3.0}, {-4.5, 0.125, -1.0}}));
}

TEST(ViewWireTest, APoseThatIsNotFiniteNamesListAndEntry) {
  v1::Poses wire = two_poses();
  wire.set_yaw_rad(1, kNan);
  const auto poses = from_wire(wire, 10, "poses");
  ASSERT_FALSE(poses);
  EXPECT_EQ(poses.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(poses.error().field, "poses.yaw_rad");
  EXPECT_NE(poses.error().message.find("entry 1"), std::string::npos);
}

TEST(ViewWireTest, APoseBeyondTheGridIsRefused) {
  v1::Poses wire = two_poses();
  wire.set_y_m(0, 1.0e7);
  EXPECT_EQ(from_wire(wire, 10, "poses").error().field, "poses.y_m");
}

TEST(ViewWireTest, ListsOfUnequalLengthAreRefused) {
  v1::Poses wire = two_poses();
  wire.add_x_m(1.0);
  EXPECT_EQ(from_wire(wire, 10, "poses").error().code, ErrorCode::kInvalidArgument);
}

TEST(ViewWireTest, NoPosesAndTooManyAreRefused) {
  EXPECT_EQ(from_wire(v1::Poses(), 10, "poses").error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(from_wire(two_poses(), 1, "poses").error().code, ErrorCode::kResourceExhausted);
}

TEST(ViewWireTest, CellsComeBackAndFarOnesAreRefused) {
  v1::Cells wire;
  to_wire(std::vector<CellIndex>{{-5, 7}, {0, -1}}, &wire);
  const auto cells = from_wire(wire, 10, "cells");
  ASSERT_TRUE(cells);
  EXPECT_EQ(*cells, (std::vector<CellIndex>{{-5, 7}, {0, -1}}));
  wire.set_ix(0, std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(from_wire(wire, 10, "cells").error().field, "cells");
}

TEST(ViewWireTest, AnAbsentAffineIsTheIdentityAndAWildOneRefused) {
  v1::Affine wire;
  EXPECT_EQ(*from_wire(wire, "affine"), MapAffine{});
  wire.set_a(1.0);
  wire.set_b(kNan);
  EXPECT_EQ(from_wire(wire, "affine").error().field, "affine");
  wire.set_b(1.0);
  wire.set_k(3.0);
  EXPECT_EQ(from_wire(wire, "affine").error().field, "affine");
}

TEST(ViewWireTest, APinholeWithoutPixelsOrFocalLengthIsRefused) {
  v1::ExactPinholes wire;
  EXPECT_EQ(camera_from_wire(wire, "pinholes").error().field, "pinholes.columns");
  wire.set_columns(64);
  EXPECT_EQ(camera_from_wire(wire, "pinholes").error().field, "pinholes.rows");
  wire.set_rows(48);
  EXPECT_EQ(camera_from_wire(wire, "pinholes").error().field, "pinholes.fx_px");
  wire.set_fx_px(50.0);
  EXPECT_EQ(camera_from_wire(wire, "pinholes").error().field, "pinholes.fy_px");
  wire.set_fy_px(50.0);
  EXPECT_TRUE(camera_from_wire(wire, "pinholes"));
  wire.set_cx_px(kNan);
  EXPECT_EQ(camera_from_wire(wire, "pinholes").error().field, "pinholes.cx_px");
}

TEST(ViewWireTest, RunsOfAnotherShapeAreDataLoss) {
  const v1::RunPanorama good = to_wire(ColumnView::from_labels(LabelImage(4, 3, 7)));
  EXPECT_TRUE(from_wire(good, 4, 3));
  EXPECT_EQ(from_wire(good, 4, 2).error().code, ErrorCode::kDataLoss);
  EXPECT_EQ(from_wire(good, 5, 3).error().code, ErrorCode::kDataLoss);
  v1::RunPanorama bad = good;
  bad.set_runs_in_column(0, 4'000'000'000U);
  EXPECT_EQ(from_wire(bad, 4, 3).error().code, ErrorCode::kDataLoss);
  bad = good;
  bad.set_end_rows(0, 65'536 + 4);
  EXPECT_EQ(from_wire(bad, 4, 3).error().code, ErrorCode::kDataLoss);
  bad = good;
  bad.mutable_labels()->pop_back();
  EXPECT_EQ(from_wire(bad, 4, 3).error().code, ErrorCode::kDataLoss);
}

TEST(ViewWireTest, LabelsMustFillTheirImage) {
  EXPECT_TRUE(labels_from_bytes(std::string(6, '\1'), 2, 3, "labels"));
  EXPECT_EQ(labels_from_bytes(std::string(5, '\1'), 2, 3, "labels").error().field, "labels");
  EXPECT_FALSE(labels_from_bytes("", 0, 0, "labels"));
  // 2^32 pixels in 32 bits would be none.
  EXPECT_FALSE(labels_from_bytes("", 65'536, 65'536, "labels"));
}

}  // namespace
}  // namespace semview::protocol
