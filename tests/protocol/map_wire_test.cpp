// SPDX-License-Identifier: Apache-2.0
#include "semview/protocol/map_wire.hpp"

#include <gtest/gtest.h>

namespace semview::protocol {
namespace {

MapDescription small_map() {
  MapDescription map;
  map.summary = {"flat", "A flat", {}};
  map.summary.fingerprint.bytes = {1, 2, 3, 255, 0, 128};
  map.classes = ClassTable({"wall", "floor", "table"});
  map.colors = {Rgb{1, 2, 3}, std::nullopt, Rgb{255, 128, 0}};
  map.ground_height_m = -0.25;
  map.profile.camera = {480, 60, -0.5, 0.75};
  map.profile.eye_height_m = 1.5;
  map.engine = "embree";
  map.engine_version = 3;
  map.engine_reason = "a mesh";
  map.free_cells = {{-3, -1}, {-2, -1}, {0, -1}, {5, 0}, {-7, 2}, {-6, 2}};
  map.glb = std::string("glTF\0\1", 6);
  map.weights_csv = "observed,wall,none\nwall,1,0\n";
  return map;
}

TEST(MapWireTest, AMapComesBackAsItWas) {
  const MapDescription map = small_map();
  const Result<MapDescription> back = from_wire(to_wire(map));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(*back, map);
}

TEST(MapWireTest, FreeCellsTravelAsRuns) {
  const v1::CellRuns wire = to_wire(std::span<const CellIndex>(small_map().free_cells));
  EXPECT_EQ(wire.length_size(), 4);
  EXPECT_EQ(wire.length(0), 2U);
}

TEST(MapWireTest, CellRunsThatWouldFillTheMemoryAreRefused) {
  v1::CellRuns wire;
  for (int i = 0; i < 3; ++i) {
    wire.add_ix(0);
    wire.add_iy(i);
    wire.add_length(2'000'000'000U);
  }
  EXPECT_EQ(from_wire(wire).error().code, ErrorCode::kDataLoss);
  wire.mutable_length()->RemoveLast();
  EXPECT_EQ(from_wire(wire).error().code, ErrorCode::kDataLoss);
}

TEST(MapWireTest, AMapWithAClassTwiceOrAHalfFingerprintIsRefused) {
  v1::GetMapReply wire = to_wire(small_map());
  *wire.add_classes() = wire.classes(0);
  EXPECT_EQ(from_wire(wire).error().code, ErrorCode::kDataLoss);
  wire = to_wire(small_map());
  wire.mutable_summary()->set_fingerprint("short");
  EXPECT_EQ(from_wire(wire).error().code, ErrorCode::kDataLoss);
}

TEST(MapWireTest, AProfileOutOfRangeNamesItsField) {
  v1::ViewProfile wire = to_wire(ViewProfile{});
  wire.set_columns(361);
  EXPECT_EQ(from_wire(wire, "profile").error().field, "profile.columns");
  wire.set_columns(4'000'000'000U);
  EXPECT_EQ(from_wire(wire, "profile").error().field, "profile.columns");
}

TEST(MapWireTest, ProgressComesBackAsItWas) {
  JobProgress progress{"1-2", "flat", JobState::kFailed, 100, 30, 20, 1.5, 2.5, Error{}};
  progress.error = Error{ErrorCode::kResourceExhausted, "disk full"};
  const Result<JobProgress> back = from_wire(to_wire(progress));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->job_id, "1-2");
  EXPECT_EQ(back->map_id, "flat");
  EXPECT_EQ(back->state, JobState::kFailed);
  EXPECT_EQ(back->total_cells, 100U);
  EXPECT_EQ(back->found_cells, 30U);
  EXPECT_EQ(back->cast_cells, 20U);
  EXPECT_EQ(back->elapsed_s, 1.5);
  EXPECT_EQ(back->remaining_s, 2.5);
  ASSERT_TRUE(back->error);
  EXPECT_EQ(back->error->code, ErrorCode::kResourceExhausted);
}

TEST(MapWireTest, AJobStateThatIsNotKnownIsRefused) {
  v1::JobStatusReply wire;
  EXPECT_EQ(from_wire(wire).error().code, ErrorCode::kDataLoss);
  wire.set_state(static_cast<v1::JobState>(17));
  EXPECT_EQ(from_wire(wire).error().code, ErrorCode::kDataLoss);
}

}  // namespace
}  // namespace semview::protocol
