// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include "map/bundle.hpp"
#include "semview/io/png.hpp"
#include "semview/map/map_checker.hpp"
#include "semview/map/plan_import.hpp"
#include "semview/map/ros_import.hpp"

namespace semview::map {
namespace {

using testing::drawing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::replaced;
using testing::TempFolder;
using testing::write_text;

const char* const kPlan =
    "name: flat level1\n"
    "image: plan.png\n"
    "resolution: 0.1\n"
    "origin: [-0.5, 1.0, 0.0]\n"
    "note: made for a test\n"
    "classes:\n"
    "- {name: unknown, ade20k_index: 0, rgb: [0, 0, 0], z_min: 0.0, z_max: 0.0}\n"
    "- {name: floor, rgb: [80, 50, 50], z_min: 0.0, z_max: 0.0}\n"
    "- {name: wall, rgb: [120, 120, 120], z_min: 0.0, z_max: 2.6}\n"
    "- {name: cabinet, rgb: [1, 2, 3], z_min: 0.0, z_max: 0.86}\n"
    "- {name: countertop, rgb: [255, 6, 82], z_min: 0.86, z_max: 1.0}\n"
    "- {name: windowpane, rgb: [230, 230, 230], z_min: 0.1, z_max: 2.4}\n"
    "- {name: door, rgb: [8, 255, 51], z_min: 0.0, z_max: 2.1}\n"
    "ceiling_z: 2.6\n"
    "above_door: wall\n"
    "below_window: wall\n"
    "above_window: wall\n";

class PlanImportTest : public ::testing::Test {
 protected:
  void SetUp() override {
    write_text(folder_ / "plan.yaml", kPlan);
    ASSERT_TRUE(io::write_png(
        folder_ / "plan.png",
        drawing({" ####WW####", " #........D", " #.T?.....D", " #........#", " ##########"})));
  }
  TempFolder folder_;
};

TEST_F(PlanImportTest, TheBundlePassesTheCheckAndStacksItsColumns) {
  const Status imported = import_plan(folder_ / "plan.yaml", folder_ / "flat");
  ASSERT_TRUE(imported) << imported.error().message;
  const MapCheck check = check_map(folder_ / "flat");
  EXPECT_TRUE(check.report.problems.empty());
  ASSERT_TRUE(check.map);
  EXPECT_EQ(check.map->id, "flat");
  EXPECT_EQ(check.map->name, "flat level1");
  const ColumnMap& columns = *check.map->columns();
  EXPECT_EQ(columns.origin, (Pose2{-0.5, 1.0, 0.0}));
  const auto id = [&](const char* name) { return check.map->classes.id(name).value(); };
  EXPECT_TRUE(columns.profile(0, 0).outside) << "unknown is outside";
  EXPECT_THAT(columns.profile(2, 3).slabs,
              ElementsAre(Slab{0.0, 0.86, id("cabinet")}, Slab{0.86, 1.0, id("countertop")}));
  EXPECT_THAT(columns.profile(0, 5).slabs,
              ElementsAre(Slab{0.0, 0.1, id("wall")},
                          Slab{0.1, 2.4, id("windowpane")},
                          Slab{2.4, 2.6, id("wall")}));
  EXPECT_THAT(columns.profile(1, 10).slabs,
              ElementsAre(Slab{0.0, 2.1, id("door")}, Slab{2.1, 2.6, id("wall")}));
  EXPECT_TRUE(columns.profile(1, 10).passable);
  EXPECT_EQ(columns.ceiling, (Ceiling{id("ceiling"), 2.6}));
  const Result<io::PngSize> occupancy = io::png_size(folder_ / "flat" / "occupancy.png");
  ASSERT_TRUE(occupancy);
  EXPECT_EQ(occupancy->columns, 11);
}

TEST_F(PlanImportTest, DoesNotOverwriteAMap) {
  ASSERT_TRUE(import_plan(folder_ / "plan.yaml", folder_ / "flat"));
  const Status again = import_plan(folder_ / "plan.yaml", folder_ / "flat");
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ErrorCode::kAlreadyExists);
}

TEST_F(PlanImportTest, SaysWhereThePlanIsWrong) {
  write_text(folder_ / "plan.yaml", replaced(kPlan, "[120, 120, 120]", "[120, 120]"));
  const Status bad_color = import_plan(folder_ / "plan.yaml", folder_ / "a");
  ASSERT_FALSE(bad_color);
  EXPECT_THAT(bad_color.error().message, HasSubstr("plan.yaml:9: "));
  write_text(folder_ / "plan.yaml", replaced(kPlan, "[1, 2, 3]", "[4, 4, 4]"));
  const Status bad_pixel = import_plan(folder_ / "plan.yaml", folder_ / "b");
  ASSERT_FALSE(bad_pixel);
  EXPECT_THAT(bad_pixel.error().message, HasSubstr("pixel (x 4, y 2)"));
}

class RosImportTest : public ::testing::Test {
 protected:
  void SetUp() override {
    write_text(folder_ / "ros.yaml",
               "image: ros.pgm\nmode: trinary\nresolution: 0.05\norigin: [-1, -2, 0]\n"
               "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n");
    std::string pgm = "P5\n8 6\n255\n";
    for (int row = 0; row < 6; ++row) {
      for (int column = 0; column < 8; ++column) {
        const bool border = row == 1 || row == 5 || column == 1 || column == 7;
        const bool unknown = row == 0 || column == 0;
        pgm += static_cast<char>(unknown ? 205 : border ? 0 : 254);
      }
    }
    write_text(folder_ / "ros.pgm", pgm);
  }
  TempFolder folder_;
};

TEST_F(RosImportTest, OccupiedIsWallFreeIsFloorUnknownIsOutside) {
  const Status imported = import_ros_map(folder_ / "ros.yaml", folder_ / "site", {2.4});
  ASSERT_TRUE(imported) << imported.error().message;
  const MapCheck check = check_map(folder_ / "site");
  EXPECT_FALSE(check.report.has_errors());
  ASSERT_TRUE(check.map);
  const ColumnMap& columns = *check.map->columns();
  EXPECT_EQ(columns.resolution_m, 0.05);
  EXPECT_EQ(columns.origin, (Pose2{-1.0, -2.0, 0.0}));
  EXPECT_TRUE(columns.profile(0, 3).outside);
  EXPECT_THAT(columns.profile(1, 3).slabs,
              ElementsAre(Slab{0.0, 2.4, check.map->classes.id("wall").value()}));
  EXPECT_TRUE(columns.profile(3, 3).slabs.empty());
  EXPECT_EQ(columns.profile(3, 3).ground, check.map->classes.id("floor").value());
}

TEST_F(RosImportTest, AFolderWhoseNameIsNoIdGivesTheMapOneMadeOfIt) {
  const Status imported = import_ros_map(folder_ / "ros.yaml", folder_ / "Ros Map 2", {2.4});
  ASSERT_TRUE(imported) << imported.error().message;
  EXPECT_EQ(load_map(folder_ / "Ros Map 2")->id, "ros_map_2");
}

TEST_F(RosImportTest, NegateSwapsBlackAndWhite) {
  write_text(folder_ / "ros.yaml",
             "image: ros.pgm\nresolution: 0.05\norigin: [-1, -2, 0]\nnegate: 1\n"
             "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  ASSERT_TRUE(import_ros_map(folder_ / "ros.yaml", folder_ / "site"));
  const Result<SemanticMap> map = load_map(folder_ / "site");
  ASSERT_TRUE(map);
  EXPECT_TRUE(map->columns()->profile(1, 3).slabs.empty()) << "black is free now";
  EXPECT_EQ(map->columns()->profile(3, 3).slabs.size(), 1U);
}

/// The classes that a row of pixels gets: `#` wall, `.` floor, ` ` outside.
std::string imported_row(const std::filesystem::path& yaml, const std::filesystem::path& folder) {
  const Status imported = import_ros_map(yaml, folder);
  EXPECT_TRUE(imported) << imported.error().message;
  const Result<RgbImage> labels = io::read_png_rgb(folder / "labels.png");
  std::string row;
  if (!labels) return row;
  for (const Rgb pixel : labels->row(0)) {
    row += pixel == testing::color_of('#') ? '#' : pixel == testing::color_of('.') ? '.' : ' ';
  }
  return row;
}

std::string ros_yaml(const std::string& image, const std::string& more) {
  return "image: " + image + "\nresolution: 0.5\norigin: [0, 0, 0]\n" + more;
}

std::string pgm_row(const std::vector<int>& greys) {
  std::string text = fmt::format("P2\n{} 1\n255\n", greys.size());
  for (const int grey : greys) text += fmt::format("{} ", grey);
  return text;
}

// The expected rows below were worked out by hand from loadMapFromFile of nav2_map_server.

TEST_F(RosImportTest, TrinaryDecidesByTheThresholdsAndKeeps205Unknown) {
  write_text(folder_ / "m.pgm", pgm_row({0, 89, 90, 191, 192, 205, 206, 254}));
  write_text(folder_ / "m.yaml",
             ros_yaml("m.pgm", "mode: trinary\noccupied_thresh: 0.65\nfree_thresh: 0.25\n"));
  EXPECT_EQ(imported_row(folder_ / "m.yaml", folder_ / "site"), "##  . ..");
}

TEST_F(RosImportTest, ScaleLeavesWhatIsBetweenTheThresholdsOutside) {
  write_text(folder_ / "m.pgm", pgm_row({0, 89, 90, 150, 191, 192, 205, 255}));
  write_text(folder_ / "m.yaml",
             ros_yaml("m.pgm", "mode: scale\noccupied_thresh: 0.65\nfree_thresh: 0.25\n"));
  EXPECT_EQ(imported_row(folder_ / "m.yaml", folder_ / "site"), "##   ...")
      << "205 is a value like any other in this mode";
}

TEST_F(RosImportTest, RawTakesGreysAsPercentAndMoreThan100AsUnknown) {
  write_text(folder_ / "m.pgm", pgm_row({0, 24, 25, 65, 66, 100, 101, 255}));
  const std::string keys = "mode: raw\noccupied_thresh: 0.65\nfree_thresh: 0.25\n";
  write_text(folder_ / "m.yaml", ros_yaml("m.pgm", keys));
  EXPECT_EQ(imported_row(folder_ / "m.yaml", folder_ / "a"), "..  ##  ");
  write_text(folder_ / "m.yaml", ros_yaml("m.pgm", keys + "negate: 1\n"));
  EXPECT_EQ(imported_row(folder_ / "m.yaml", folder_ / "b"), "..  ##  ") << "Nav2 does not negate";
}

/// A row of grey and alpha; libpng, since semview writes no alpha.
void write_grey_alpha(const std::filesystem::path& path, const std::vector<png_byte>& samples) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(samples.size() / 2);
  image.height = 1;
  image.format = PNG_FORMAT_GA;
  ASSERT_NE(png_image_write_to_file(&image, path.c_str(), 0, samples.data(), 0, nullptr), 0);
}

TEST_F(RosImportTest, ATransparentPixelIsUnknownInModeScale) {
  write_grey_alpha(folder_ / "m.png", {0, 255, 255, 255, 0, 0, 255, 254, 0, 255});
  write_text(folder_ / "m.yaml", ros_yaml("m.png", "mode: scale\n"));
  EXPECT_EQ(imported_row(folder_ / "m.yaml", folder_ / "site"), "#.  #");
}

TEST_F(RosImportTest, AlphaTakesPartInTheMeanInModeTrinary) {
  // Means of three greys and alpha: 63.75 (occupancy 0.75), 0 (1), 255 (0), 191.25 (0.25).
  write_grey_alpha(folder_ / "m.png", {0, 255, 0, 0, 255, 255, 255, 0});
  write_text(folder_ / "m.yaml", ros_yaml("m.png", "occupied_thresh: 0.8\nfree_thresh: 0.2\n"));
  EXPECT_EQ(imported_row(folder_ / "m.yaml", folder_ / "site"), " #. ");
}

TEST_F(RosImportTest, AnErrorNamesTheLineOfTheValue) {
  const auto error_of = [&](const std::string& more) {
    write_text(folder_ / "m.yaml", ros_yaml("ros.pgm", more));
    const Status imported = import_ros_map(folder_ / "m.yaml", folder_ / "site");
    EXPECT_FALSE(imported) << more;
    return imported ? std::string() : imported.error().message;
  };
  EXPECT_THAT(error_of("mode: colour\n"),
              HasSubstr("m.yaml:4: mode 'colour' is not trinary, scale or raw"));
  EXPECT_THAT(error_of("negate: maybe\n"), HasSubstr("m.yaml:4: negate"));
  EXPECT_THAT(error_of("occupied_thresh: 0.2\nfree_thresh: 0.9\n"),
              HasSubstr("m.yaml:5: free_thresh 0.9 is not below occupied_thresh 0.2"));
  EXPECT_THAT(error_of("free_thresh: 0.1\noccupied_thresh: 65\n"),
              HasSubstr("m.yaml:5: occupied_thresh 65 is not in 0..1"));
  write_text(folder_ / "m.yaml", "image: no.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n");
  const Status missing = import_ros_map(folder_ / "m.yaml", folder_ / "site");
  EXPECT_THAT(missing.error().message, HasSubstr("m.yaml:1: image "));
  write_text(folder_ / "m.yaml", "image: ros.pgm\norigin: [0, 0, 0]\nresolution: 50\n");
  const Status coarse = import_ros_map(folder_ / "m.yaml", folder_ / "site");
  EXPECT_THAT(coarse.error().message, HasSubstr("m.yaml:3: resolution 50 m per pixel"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "site")) << "nothing was begun";
}

}  // namespace
}  // namespace semview::map
