// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/bundle.hpp"
#include "semview/map/semantic_map.hpp"
#include "support/paths.hpp"

namespace semview::map {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::map_yaml;
using testing::replaced;
using testing::room;
using testing::TempFolder;
using testing::write_bundle;

class LoadMapTest : public ::testing::Test {
 protected:
  TempFolder folder_;
};

TEST_F(LoadMapTest, AFolderAndItsFileAreOneMap) {
  write_bundle(folder_.path(), room());
  const Result<SemanticMap> by_folder = load_map(folder_.path());
  const Result<SemanticMap> by_file = load_map(folder_ / "map.yaml");
  ASSERT_TRUE(by_folder) << by_folder.error().message;
  ASSERT_TRUE(by_file) << by_file.error().message;
  EXPECT_EQ(by_folder->fingerprint, by_file->fingerprint);
  EXPECT_EQ(by_folder->name, "Test room");
  EXPECT_EQ(by_folder->directory, folder_.path());
}

TEST_F(LoadMapTest, ClassesKeepTheOrderOfTheFile) {
  write_bundle(folder_.path(), room());
  const Result<SemanticMap> map = load_map(folder_.path());
  ASSERT_TRUE(map);
  EXPECT_THAT(map->classes.names(),
              ElementsAre("ceiling", "floor", "wall", "door", "window", "table"));
  ASSERT_EQ(map->class_details.size(), 6U);
  EXPECT_FALSE(map->class_details[0].color);
  EXPECT_TRUE(map->class_details[3].passable) << "a class named door is, by default";
  EXPECT_FALSE(map->class_details[4].passable);
  EXPECT_EQ(map->class_details[5].movable, 0.5);
  EXPECT_THAT(map->class_details[5].aliases, ElementsAre("desk"));
  EXPECT_EQ(map->ground_label, 2);
  EXPECT_EQ(map->ceiling, (Ceiling{1, 2.6}));
}

TEST_F(LoadMapTest, EveryPixelHasTheColumnOfItsColour) {
  write_bundle(folder_.path(), room());
  const Result<SemanticMap> map = load_map(folder_.path());
  ASSERT_TRUE(map);
  const ColumnMap* columns = map->columns();
  ASSERT_NE(columns, nullptr);
  EXPECT_TRUE(columns->profile(0, 0).outside);
  EXPECT_THAT(columns->profile(1, 1).slabs, ElementsAre(Slab{0.0, 2.6, 3}));
  EXPECT_THAT(columns->profile(1, 5).slabs,
              ElementsAre(Slab{0.0, 0.9, 3}, Slab{0.9, 2.1, 5}, Slab{2.1, 2.6, 3}));
  EXPECT_THAT(columns->profile(5, 10).slabs, ElementsAre(Slab{0.0, 2.1, 4}, Slab{2.1, 2.6, 3}));
  EXPECT_TRUE(columns->profile(5, 10).passable);
  EXPECT_THAT(columns->profile(4, 4).slabs, ElementsAre(Slab{0.7, 0.75, 6}));
  EXPECT_TRUE(columns->profile(2, 2).slabs.empty());
  EXPECT_EQ(columns->profile(2, 2).ground, 2);
  // Row 9 is the lowest: pixel (9, 0) begins at the origin (-1, 2).
  EXPECT_EQ(columns->pixel_at(-0.95, 2.05), (PixelIndex{9, 0}));
}

TEST_F(LoadMapTest, OriginYawTurnsTheImage) {
  write_bundle(
      folder_.path(), room(), replaced(map_yaml(), "2.0, 0.0]", "2.0, 1.5707963267948966]"));
  const Result<SemanticMap> map = load_map(folder_.path());
  ASSERT_TRUE(map);
  EXPECT_EQ(map->columns()->pixel_at(-1.05, 2.05), (PixelIndex{9, 0}));
  EXPECT_EQ(map->columns()->pixel_at(-1.05, 2.15), (PixelIndex{9, 1}));
}

TEST_F(LoadMapTest, GroundAndHeightsMayLieAnywhere) {
  std::string yaml = replaced(map_yaml(), "height: 0.0}", "height: 3.0}");
  yaml = replaced(yaml, "height: 2.6}", "height: 5.6}");
  yaml = replaced(yaml, "min_height: 0, max_height: 0}", "min_height: 3, max_height: 3}");
  yaml = replaced(yaml, "min_height: 0, max_height: 2.6}", "min_height: 3, max_height: 5.6}");
  yaml = replaced(yaml, "min_height: 0, max_height: 2.1", "min_height: 3, max_height: 5.1");
  yaml = replaced(yaml, "min_height: 0.9, max_height: 2.1", "min_height: 3.9, max_height: 5.1");
  yaml = replaced(yaml, "min_height: 0.7, max_height: 0.75", "min_height: 3.7, max_height: 3.75");
  write_bundle(folder_.path(), room(), yaml);
  const Result<SemanticMap> map = load_map(folder_.path());
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->ground_height_m, 3.0);
  EXPECT_THAT(map->columns()->profile(5, 10).slabs,
              ElementsAre(Slab{3.0, 5.1, 4}, Slab{5.1, 5.6, 3}));
}

TEST_F(LoadMapTest, OpenTopHasNoCeiling) {
  write_bundle(folder_.path(),
               room(),
               replaced(map_yaml(), "  ceiling: {class: ceiling, height: 2.6}\n", ""));
  const Result<SemanticMap> map = load_map(folder_.path());
  ASSERT_TRUE(map);
  EXPECT_FALSE(map->ceiling);
  EXPECT_FALSE(map->columns()->ceiling);
}

TEST_F(LoadMapTest, TheFirstErrorOfTheCheckIsReturned) {
  write_bundle(
      folder_.path(), room(), replaced(map_yaml(), "min_height: 0.7,", "min_height: 2.4,"));
  const Result<SemanticMap> map = load_map(folder_.path());
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(map.error().message, HasSubstr("map.yaml:19: min_height 2.4"));
}

TEST_F(LoadMapTest, NothingThereIsNotFound) {
  EXPECT_EQ(load_map(folder_ / "nowhere").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(load_map(folder_.path()).error().code, ErrorCode::kNotFound) << "no map.yaml in it";
}

// Mesh maps

const char* const kDuplexGlb = SEMVIEW_SOURCE_DIR "/maps/duplex_building/semantic.glb";

TEST_F(LoadMapTest, ABareGlbSortsItsClassesAndIsNamedAfterItsFile) {
  std::filesystem::copy_file(kDuplexGlb, folder_ / "My Flat.glb");
  const Result<SemanticMap> map = load_map(folder_ / "My Flat.glb");
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->id, "my_flat");
  EXPECT_TRUE(std::is_sorted(map->classes.names().begin(), map->classes.names().end()));
  EXPECT_EQ(map->ground_height_m, 0.0);
  EXPECT_EQ(map->classes.name(map->ground_label), "floor");
  ASSERT_NE(map->mesh(), nullptr);
  EXPECT_EQ(map->mesh()->mesh.labels.size(), map->mesh()->mesh.triangles.size());
}

TEST_F(LoadMapTest, AMeshMapTakesIdsFromItsList) {
  const Result<SemanticMap> map = load_map(SEMVIEW_SOURCE_DIR "/maps/duplex_building");
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->classes.name(1), "floor");
  EXPECT_EQ(map->classes.name(2), "wall");
  EXPECT_NE(map->fingerprint, load_map(kDuplexGlb)->fingerprint) << "the ids differ";
}

TEST_F(LoadMapTest, AMeshsClassesAreAllListed) {
  std::filesystem::copy_file(kDuplexGlb, folder_ / "flat.glb");
  testing::write_text(folder_ / "map.yaml",
                      "semview:\n  format: 1\n  id: flat\n  mesh: flat.glb\n  classes:\n"
                      "    - {name: floor}\n    - {name: wall}\n");
  const Result<SemanticMap> map = load_map(folder_.path());
  ASSERT_FALSE(map);
  EXPECT_THAT(map.error().message, HasSubstr("flat.glb"));
  EXPECT_THAT(map.error().message, HasSubstr("railing"));
  EXPECT_THAT(map.error().message, HasSubstr("windowpane"));
}

}  // namespace
}  // namespace semview::map
