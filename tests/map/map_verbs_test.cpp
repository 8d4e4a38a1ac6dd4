// SPDX-License-Identifier: Apache-2.0
/// The built program: exit codes and what scripts read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "map/bundle.hpp"
#include "semview/io/png.hpp"
#include "support/engine_wish.hpp"
#include "support/run_program.hpp"

namespace semview::map {
namespace {

using nlohmann::json;
using semview::testing::Outcome;
using ::testing::HasSubstr;
using testing::map_yaml;
using testing::replaced;
using testing::room;
using testing::TempFolder;
using testing::write_bundle;

Outcome semview_map(const std::string& arguments) {
  return semview::testing::run_semview("map " + arguments);
}

class MapVerbsTest : public ::testing::Test {
 protected:
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  TempFolder folder_;
};

TEST_F(MapVerbsTest, CheckExitsWith0Or1Or2) {
  write_bundle(folder_ / "good", room());
  write_bundle(
      folder_ / "bad", room(), replaced(map_yaml(), "min_height: 0.7,", "min_height: 2.4,"));
  EXPECT_EQ(semview_map("check " + at("good")).exit_code, 0);
  const Outcome bad = semview_map("check " + at("good") + " " + at("bad"));
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.output, HasSubstr(at("bad") + "/map.yaml:19: error: min_height 2.4"));
  EXPECT_EQ(semview_map("check").exit_code, 2);
  EXPECT_EQ(semview_map("check --no-such-option").exit_code, 2);
}

TEST_F(MapVerbsTest, CheckFindsTwoMapsWithOneId) {
  write_bundle(folder_ / "a", room());
  write_bundle(folder_ / "b", room());
  const Outcome run = semview_map("check --json " + at("a") + " " + at("b"));
  EXPECT_EQ(run.exit_code, 1);
  const json report = json::parse(run.answer);
  ASSERT_EQ(report.size(), 2U);
  EXPECT_TRUE(report[0]["ok"].get<bool>());
  EXPECT_FALSE(report[1]["ok"].get<bool>());
  EXPECT_THAT(report[1]["problems"][0]["message"].get<std::string>(), HasSubstr("test_room"));
}

TEST_F(MapVerbsTest, InfoNamesWhatAServerNeeds) {
  const Outcome run = semview_map("info --json " SEMVIEW_SOURCE_DIR "/maps/tutorial");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const json info = json::parse(run.answer);
  EXPECT_EQ(info["id"], "tutorial");
  EXPECT_EQ(info["fingerprint"].get<std::string>().size(), 32U);
  EXPECT_GT(info["free_cells"].get<int>(), 2000);
  EXPECT_EQ(info["classes"][0]["name"], "ceiling");
  EXPECT_EQ(info["engine"], semview::testing::plan_engine());
}

TEST_F(MapVerbsTest, ObjectsAreCountedAndTheirMistakesNameTheFeature) {
  const std::string object =
      R"({"type": "FeatureCollection", "features": [{"type": "Feature",
          "properties": {"class": "table", "min_height": 0.4}, "geometry": {"type": "Polygon",
          "coordinates": [[[-0.5, 2.2], [-0.2, 2.2], [-0.2, 2.4], [-0.5, 2.4], [-0.5, 2.2]]]}}]})";
  write_bundle(folder_ / "a",
               room(),
               replaced(map_yaml(), "  outside:", "  objects: objects.geojson\n  outside:"));
  testing::write_text(folder_ / "a/objects.geojson", object);
  const Outcome info = semview_map("info --json " + at("a"));
  ASSERT_EQ(info.exit_code, 0) << info.output;
  EXPECT_EQ(json::parse(info.answer)["objects"], 1);
  EXPECT_EQ(json::parse(info.answer)["object_profiles"], 1);

  testing::write_text(folder_ / "a/objects.geojson", replaced(object, "0.4", "4"));
  const Outcome check = semview_map("check --json " + at("a"));
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_EQ(json::parse(check.answer)[0]["problems"][0]["feature"], 1);
}

TEST_F(MapVerbsTest, InfoOfAMeshMapCountsFreeCells) {
  const Outcome run = semview_map("info --json " SEMVIEW_SOURCE_DIR "/maps/duplex_building");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const json info = json::parse(run.answer);
  EXPECT_EQ(info["kind"], "mesh");
  EXPECT_EQ(info["engine"], "embree");
  EXPECT_FALSE(info["engine_reason"].get<std::string>().empty());
  // The storeys' floors are 3.1 m apart, and the house is two of them high.
  EXPECT_GT(info["size_m"][2].get<double>(), 5.0);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(
        info["size_m"][axis].get<double>(),
        info["bounds_m"]["max"][axis].get<double>() - info["bounds_m"]["min"][axis].get<double>(),
        1e-9);
  }
  EXPECT_GT(info["free_cells"].get<int>(), 5000);
}

TEST_F(MapVerbsTest, CheckTellsAMeshWithoutFreeSpaceHowHighItReaches) {
  write_bundle(folder_ / "map", room());
  ASSERT_EQ(semview_map("export " + at("map") + " " + at("room.glb")).exit_code, 0);
  std::filesystem::create_directory(folder_ / "mesh");
  std::filesystem::rename(folder_ / "room.glb", folder_ / "mesh" / "room.glb");
  const std::string yaml =
      "semview:\n  format: 1\n  mesh: room.glb\n  ground: {class: floor, height: 1.5}\n"
      "  classes: [{name: ceiling}, {name: floor}, {name: wall}, {name: door}, {name: window},"
      " {name: table}]\n";
  testing::write_text(folder_ / "mesh" / "map.yaml", yaml);
  const Outcome run = semview_map("check " + at("mesh"));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.output, HasSubstr("mesh/room.glb: error: there is no free space"));
  EXPECT_THAT(run.output, HasSubstr("the mesh reaches from z = 0.00 to 2.60"));
}

TEST_F(MapVerbsTest, InfoIsReadableForPeople) {
  write_bundle(folder_ / "map", room());
  const Outcome run = semview_map("info " + at("map"));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.output, HasSubstr("12 x 10 pixels of 0.1 m"));
  EXPECT_THAT(run.output, HasSubstr("1.20 x 1.00 x 2.60 m (width, depth, height)"));
  EXPECT_THAT(run.output, HasSubstr("x -1.00 to 0.20, y 2.00 to 3.00, z 0.00 to 2.60 m"));
}

TEST_F(MapVerbsTest, PreviewAndOccupancyWritePictures) {
  write_bundle(folder_ / "map", room());
  ASSERT_EQ(semview_map("preview " + at("map") + " -o " + at("plan.png")).exit_code, 0);
  const auto plan = io::read_png_rgb(folder_ / "plan.png");
  ASSERT_TRUE(plan);
  EXPECT_GT(plan->columns(), 600) << "enlarged, with a legend";
  ASSERT_EQ(semview_map("occupancy " + at("map")).exit_code, 0);
  EXPECT_TRUE(io::read_png_grey(folder_ / "map" / "occupancy.png"));
  const Outcome nowhere = semview_map("preview " + at("nothing") + " -o " + at("x.png"));
  EXPECT_EQ(nowhere.exit_code, 1);
  EXPECT_THAT(nowhere.output, HasSubstr("no such file or folder"));
}

}  // namespace
}  // namespace semview::map
