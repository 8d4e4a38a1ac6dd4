// SPDX-License-Identifier: Apache-2.0
#include "semview/evaluation/room_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/io/text_file.hpp"
#include "support/temporary_folder.hpp"

namespace semview::evaluation {
namespace {

using semview::testing::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<NamedRoom> kTrue{{"hall", 0.0, 0.0, 2.0, 4.0}, {"kitchen", 2.0, 0.0, 6.0, 4.0}};
const std::vector<NamedRoom> kDrawn{{"kitchen", 3.0, 0.0, 5.0, 4.0}, {"hall", 0.0, 0.0, 3.0, 4.0}};

TEST(RoomPlanTest, APlaceKeepsItsShareOfItsRoom) {
  const auto moved = moved_with_room(kTrue, kDrawn, {3.0, 1.0, 0.5});
  ASSERT_TRUE(moved);
  EXPECT_DOUBLE_EQ(moved->x_m, 3.5);
  EXPECT_DOUBLE_EQ(moved->y_m, 1.0);
  EXPECT_DOUBLE_EQ(moved->yaw_rad, 0.5);
  EXPECT_FALSE(moved_with_room(kTrue, kDrawn, {-1.0, 1.0, 0.0}));
}

TEST(RoomPlanTest, RoomsAreComparedByNameAndCountedOncePerVisit) {
  const std::vector<Pose2> truth{{1, 1, 0}, {1, 2, 0}, {3, 1, 0}, {5, 1, 0}, {1, 1, 0}, {9, 9, 0}};
  const std::vector<Pose2> found{
      {1.5, 1, 0}, {2.5, 2, 0}, {2.9, 1, 0}, {4, 1, 0}, {7, 7, 0}, {1, 1, 0}};
  const RoomScore score = score_rooms(kTrue, kDrawn, truth, found);
  EXPECT_EQ(score.places, 5U);
  EXPECT_EQ(score.outside, 1U);
  EXPECT_EQ(score.right, 3U);
  EXPECT_THAT(score.true_order, ElementsAre("hall", "kitchen", "hall"));
  EXPECT_THAT(score.found_order, ElementsAre("hall", "kitchen", ""));
}

TEST(RoomPlanTest, OfOverlappingRoomsTheFirstCounts) {
  const std::vector<NamedRoom> rooms{{"hall", 0, 0, 3, 4}, {"kitchen", 2, 0, 6, 4}};
  EXPECT_EQ(room_at(rooms, {2.5, 1.0, 0.0})->name, "hall");
  EXPECT_EQ(room_at(rooms, {3.0, 1.0, 0.0})->name, "kitchen");
}

TEST(RoomPlanTest, FilesAreReadAndErrorsNamedByLine) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    EXPECT_TRUE(io::write_text_file(folder / "rooms.csv", text));
    return read_rooms(folder / "rooms.csv");
  };
  const std::string header = "# rooms\nroom,min_x_m,min_y_m,max_x_m,max_y_m\n";
  const auto rooms = read(header + "hall,0,-1,2.5,4\n\nliving room,2.5,0,6,4\n");
  ASSERT_TRUE(rooms);
  ASSERT_EQ(rooms->size(), 2U);
  EXPECT_EQ(rooms->back().name, "living room");
  EXPECT_DOUBLE_EQ(rooms->front().min_y_m, -1.0);
  for (const char* line :
       {"hall,0,0,1", "hall,0,0,1,1,1", ",0,0,1,1", "hall,1,0,1,1", "hall,0,0,inf,1"}) {
    const auto wrong = read(header + line + "\n");
    ASSERT_FALSE(wrong) << line;
    EXPECT_THAT(wrong.error().message, HasSubstr("rooms.csv:3: expected")) << line;
  }
  EXPECT_FALSE(read(header + "hall,0,0,1,1\nhall,1,1,2,2\n"));
  EXPECT_FALSE(read(header));
  EXPECT_FALSE(read("hall,0,0,1,1\n"));
}

}  // namespace
}  // namespace semview::evaluation
