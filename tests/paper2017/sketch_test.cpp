// SPDX-License-Identifier: Apache-2.0
#include "experiments/paper2017/sketch.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "experiments/paper2017/sketch_drives.hpp"
#include "experiments/paper2017/sketch_records.hpp"
#include "experiments/paper2017/sketch_report.hpp"

namespace semview::paper2017 {
namespace {

constexpr std::uint64_t kSeeds[] = {1, 2, 3, 201, 202};

TEST(SketchTest, RoomsKeepTheirPlacesAmongEachOther) {
  for (const std::uint64_t seed : kSeeds) {
    const Layout truth = draw_layout({}, seed);
    const Sketch sketch = draw_sketch(truth, {}, seed);
    for (std::size_t i = 0; i < truth.rooms.size(); ++i) {
      const Room& room = truth.rooms[i];
      const Pose2 middle{
          (room.min_x_m + room.max_x_m) / 2.0, (room.min_y_m + room.max_y_m) / 2.0, 0.3};
      const Pose2 moved = sketch.sketch_from_true(middle);
      EXPECT_EQ(room_of(sketch.drawn.rooms, moved), i) << seed;
      EXPECT_DOUBLE_EQ(moved.yaw_rad, 0.3);
    }
    EXPECT_EQ(room_of(sketch.drawn.rooms, {-1.0, 1.0, 0.0}), kNoRoom);
  }
}

TEST(SketchTest, SidesAreStretchedWithinTheGuess) {
  for (const std::uint64_t seed : kSeeds) {
    const Layout truth = draw_layout({}, seed);
    const Sketch sketch = draw_sketch(truth, {}, seed);
    for (std::size_t i = 0; i < truth.rooms.size(); ++i) {
      const Room& from = truth.rooms[i];
      const Room& to = sketch.drawn.rooms[i];
      const double depth = (to.max_y_m - to.min_y_m) / (from.max_y_m - from.min_y_m);
      EXPECT_GE(depth, 0.7 - 1e-9);
      EXPECT_LE(depth, 1.4 + 1e-9);
      // The upper row is stretched to the lower one's length, by at most 1.4 / 0.7 either way.
      const double length = (to.max_x_m - to.min_x_m) / (from.max_x_m - from.min_x_m);
      EXPECT_GE(length, 0.35);
      EXPECT_LE(length, 2.8);
    }
  }
}

TEST(SketchTest, SharesOfMissingAndSwappedThingsAreThoseAskedFor) {
  std::size_t furniture = 0, gone = 0, swapped = 0, walls = 0, missing = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Layout truth = draw_layout({}, seed);
    const Sketch sketch = draw_sketch(truth, {}, seed);
    for (std::size_t i = 0; i < truth.furniture.size(); ++i) {
      if (!truth.furniture[i].in_map) continue;
      ++furniture;
      gone += sketch.drawn.furniture[i].in_map ? 0 : 1;
      swapped += sketch.drawn.furniture[i].kind != truth.furniture[i].kind ? 1 : 0;
    }
    for (std::size_t i = 6; i < truth.walls.size(); ++i) {
      ++walls;
      missing += sketch.drawn.walls[i].to_m <= sketch.drawn.walls[i].from_m ? 1 : 0;
    }
  }
  // Four σ of a binomial share.
  const auto expect_share = [](std::size_t count, std::size_t of, double share) {
    const double sigma = std::sqrt(share * (1.0 - share) / static_cast<double>(of));
    EXPECT_NEAR(static_cast<double>(count) / static_cast<double>(of), share, 4.0 * sigma);
  };
  expect_share(gone, furniture, 1.0 / 6.0);
  expect_share(swapped, furniture, 1.0 / 6.0);
  expect_share(missing, walls, 0.1);
}

TEST(SketchTest, EqualSeedsMakeEqualSketches) {
  const Layout truth = draw_layout({}, 1);
  const Sketch one = draw_sketch(truth, {}, 5);
  const Sketch same = draw_sketch(truth, {}, 5);
  const Sketch other = draw_sketch(truth, {}, 6);
  EXPECT_EQ(one.drawn.width_m, same.drawn.width_m);
  EXPECT_NE(one.drawn.width_m, other.drawn.width_m);
}

/// A drive through rooms, and where it was thought to be.
SketchDrive drive_through(std::vector<std::size_t> true_rooms, std::vector<std::size_t> found) {
  SketchDrive drive;
  drive.method = "some";
  for (std::size_t i = 0; i < true_rooms.size(); ++i) {
    SketchStop stop;
    stop.true_room = true_rooms[i];
    stop.found_room = found[i];
    stop.estimate.x_m = static_cast<double>(i);
    drive.stops.push_back(stop);
  }
  return drive;
}

TEST(SketchReportTest, OrderIsThatOfRoomsWithoutRepetitions) {
  EXPECT_TRUE(in_right_order(drive_through({0, 0, 2, 2, 1}, {0, 2, 2, 1, 1})));
  EXPECT_FALSE(in_right_order(drive_through({0, 2, 1}, {0, 1, 1})));
  EXPECT_FALSE(in_right_order(drive_through({0, 0, 1}, {0, kNoRoom, 1})));
}

TEST(SketchReportTest, SharesAreOfStopsAndOfDrives) {
  const std::vector<SketchDrive> drives{drive_through({0, 0, 0, 1}, {0, 0, 0, 1}),
                                        drive_through({0, 0, 0, 1}, {0, 0, 0, 2})};
  const std::vector<SketchSummary> summaries = summarize(drives);
  ASSERT_EQ(summaries.size(), 1U);
  EXPECT_EQ(summaries[0].drives, 2U);
  EXPECT_DOUBLE_EQ(summaries[0].right_room_share, 7.0 / 8.0);
  EXPECT_DOUBLE_EQ(summaries[0].late_share, 0.5);
  EXPECT_DOUBLE_EQ(summaries[0].right_order_share, 0.5);
  EXPECT_DOUBLE_EQ(summaries[0].mean_error_m, 1.5);
  EXPECT_NE(to_csv(drives).find("\n1,1,some,local,1,4,1,2,"), std::string::npos);
}

TEST(SketchRecordsTest, CsvIsReadBackAsItWas) {
  const std::vector<SketchDrive> drives{drive_through({0, 0, 1}, {0, kNoRoom, 1}),
                                        drive_through({2, 1}, {2, 1})};
  std::string text = to_csv(std::span(drives).first(1));
  SketchDrive other = drives[1];
  other.run = 2;
  text += to_csv({&other, 1});
  const auto read = parse_sketch_drives(text, "sketch_stops.csv");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 2U);
  EXPECT_EQ(read->at(0).stops[1].found_room, kNoRoom);
  EXPECT_EQ(to_csv(std::span(*read).first(1)), to_csv(std::span(drives).first(1)));
  EXPECT_EQ(to_csv({&read->at(1), 1}), to_csv({&other, 1}));

  const auto damaged = parse_sketch_drives(text + "1,1,some,sideways\n", "sketch_stops.csv");
  ASSERT_FALSE(damaged);
  EXPECT_EQ(damaged.error().message.rfind("sketch_stops.csv:8:", 0), 0U) << damaged.error().message;
}

TEST(SketchDrivesTest, BadOptionsAreRefusedByName) {
  const auto field = [](const auto& change) {
    SketchSettings settings;
    settings.out = "unused";
    change(settings);
    const Status status = validate(settings);
    return status ? std::string("accepted") : status.error().field;
  };
  EXPECT_EQ(field([](SketchSettings&) {}), "accepted");
  EXPECT_EQ(field([](SketchSettings& settings) { settings.sketches = 0; }), "--sketches");
  EXPECT_EQ(field([](SketchSettings& settings) { settings.runs = 0; }), "--runs");
  EXPECT_EQ(field([](SketchSettings& settings) { settings.methods = {"best"}; }), "--methods");
  EXPECT_EQ(field([](SketchSettings& settings) { settings.worlds = {101}; }), "--worlds");
}

}  // namespace
}  // namespace semview::paper2017
