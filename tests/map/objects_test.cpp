// SPDX-License-Identifier: Apache-2.0
// Objects with heights of their own: docs/formats/map_bundle.md#objects.
#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/bundle.hpp"
#include "map/map_checker_fixture.hpp"
#include "semview/core/random.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/distorted_bundle.hpp"
#include "semview/map/distortion.hpp"
#include "semview/map/occupancy.hpp"
#include "support/paths.hpp"

namespace semview::map {
namespace {

using ::testing::HasSubstr;
using testing::map_yaml;
using testing::replaced;
using testing::room;

constexpr ClassId kFloor = 2;
constexpr ClassId kWall = 3;
constexpr ClassId kWindow = 5;
constexpr ClassId kTable = 6;

std::string objects_yaml() {
  return replaced(map_yaml(), "  ceiling: {", "  objects: objects.geojson\n  ceiling: {");
}

std::string collection(const std::vector<std::string>& features) {
  return fmt::format(R"({{"type": "FeatureCollection", "features": [{}]}})",
                     fmt::join(features, ", "));
}

/// In pixels of `room()`, from the left and from below.
std::string box(int left, int low, int right, int high) {
  const auto point = [](int u, int v) {
    return fmt::format("[{}, {}]", -1.0 + 0.1 * u, 2.0 + 0.1 * v);
  };
  return fmt::format("[[{}, {}, {}, {}, {}]]",
                     point(left, low),
                     point(right, low),
                     point(right, high),
                     point(left, high),
                     point(left, low));
}

std::string feature(const std::string& properties, const std::string& coordinates) {
  return fmt::format(
      R"({{"type": "Feature", "properties": {{{}}}, "geometry": {{"type": "Polygon", "coordinates": {}}}}})",
      properties,
      coordinates);
}

class ObjectsTest : public MapCheckerTest {
 protected:
  void write(const std::string& geojson, const std::vector<std::string>& rows = room()) {
    testing::write_bundle(folder_.path(), rows, objects_yaml());
    testing::write_text(folder_ / "objects.geojson", geojson);
  }
  SemanticMap load(const std::vector<std::string>& features) {
    write(collection(features));
    Result<SemanticMap> map = load_map(folder_.path());
    EXPECT_TRUE(map) << map.error().message;
    return map ? *std::move(map) : SemanticMap{};
  }
  /// The one problem of a file.
  std::string problem(const std::string& geojson, Severity severity) {
    write(geojson);
    const MapProblem found = only(check_map(folder_.path()), severity);
    EXPECT_EQ(found.file.filename(), "objects.geojson");
    EXPECT_FALSE(found.remedy.empty()) << found.message;
    return to_string(found);
  }
  std::string error(const std::string& one_feature) {
    return problem(collection({one_feature}), Severity::kError);
  }
  Fingerprint drawn_only() {
    testing::write_bundle(folder_.path(), room());
    return load_map(folder_.path())->fingerprint;
  }
};

TEST_F(ObjectsTest, APixelInsideGetsItsOwnProfile) {
  // The upper right of the floor, over the table in part; the drawing's other pixels are as before.
  const SemanticMap map =
      load({feature(R"("class": "table", "min_height": 0.9, "max_height": 1.0)", box(5, 5, 7, 8))});
  const ColumnMap& plan = *map.columns();
  const std::vector<Slab> high{{0.9, 1.0, kTable}};
  const std::vector<Slab> low{{0.7, 0.75, kTable}};
  EXPECT_EQ(plan.profile(4, 4).slabs, low) << "left of it, as drawn";
  EXPECT_EQ(plan.profile(4, 5).slabs, high) << "drawn as table, with heights of its own";
  EXPECT_EQ(plan.profile(3, 6).slabs, high) << "drawn as floor";
  EXPECT_EQ(plan.profile(3, 6).ground, kFloor);
  EXPECT_EQ(plan.profile(3, 7).slabs, std::vector<Slab>{});
  EXPECT_EQ(map.objects.features, 1U);
  ASSERT_EQ(map.objects.profiles.size(), 1U);
  EXPECT_EQ(plan.profiles.size(), 7U);
}

TEST_F(ObjectsTest, OverLimitsItToClassesSoThatARoomsOutlineRaisesItsSills) {
  const SemanticMap map =
      load({feature(R"("class": "window", "min_height": 1.4, "max_height": null, "over": "window")",
                    box(0, 0, 12, 10))});
  const ColumnMap& plan = *map.columns();
  const std::vector<Slab> raised{{0.0, 1.4, kWall}, {1.4, 2.1, kWindow}, {2.1, 2.6, kWall}};
  EXPECT_EQ(plan.profile(1, 5).slabs, raised) << "below and above as the class has them";
  EXPECT_EQ(plan.profile(1, 4).slabs.size(), 1U) << "wall";
  EXPECT_TRUE(plan.profile(2, 5).slabs.empty()) << "floor";
}

TEST_F(ObjectsTest, LaterFeaturesWinAndOutsideStaysOutside) {
  const std::string table = R"("class": "table", "min_height": 0.5, "max_height": 0.6)";
  const std::string wall = R"("class": "wall", "max_height": 1.0)";
  SemanticMap map = load({feature(table, box(0, 2, 12, 8)), feature(wall, box(3, 3, 5, 5))});
  EXPECT_EQ(map.columns()->profile(5, 3).slabs, (std::vector<Slab>{{0.0, 1.0, kWall}}));
  EXPECT_EQ(map.columns()->profile(5, 5).slabs, (std::vector<Slab>{{0.5, 0.6, kTable}}));
  EXPECT_TRUE(map.columns()->profile(5, 0).outside);
  map = load({feature(wall, box(3, 3, 5, 5)), feature(table, box(0, 2, 12, 8))});
  EXPECT_EQ(map.columns()->profile(5, 3).slabs, (std::vector<Slab>{{0.5, 0.6, kTable}}));
}

TEST_F(ObjectsTest, BelowAndAboveCanBeGivenOrTakenAway) {
  const SemanticMap map =
      load({feature(R"("class": "window", "min_height": 1.0, "below": "none", "above": "table")",
                    box(5, 8, 6, 9))});
  EXPECT_EQ(map.columns()->profile(1, 5).slabs, (std::vector<Slab>{{1.0, 2.1, kWindow}}))
      << "table ends lower, which adds nothing";
  const SemanticMap filled =
      load({feature(R"("class": "table", "below": "wall")", box(4, 4, 5, 5))});
  EXPECT_EQ(filled.columns()->profile(5, 4).slabs,
            (std::vector<Slab>{{0.0, 0.7, kWall}, {0.7, 0.75, kTable}}));
}

TEST_F(ObjectsTest, HolesStayAsDrawnAndMultiPolygonsAreOneObject) {
  const std::string outline = box(2, 2, 7, 7);
  const std::string hole = box(4, 4, 6, 6);
  const std::string with_hole =
      outline.substr(0, outline.size() - 1) + ", " + hole.substr(1, hole.size() - 1);
  SemanticMap map = load({feature(R"("class": "wall", "max_height": 1.0)", with_hole)});
  EXPECT_EQ(map.columns()->profile(7, 2).slabs.size(), 1U);
  EXPECT_EQ(map.columns()->profile(4, 4).slabs, (std::vector<Slab>{{0.7, 0.75, kTable}}));
  map = load({fmt::format(
      R"({{"type": "Feature", "id": 7, "bbox": [0, 0, 1, 1], "properties": {{"class": "wall", "max_height": 1}}, "geometry": {{"type": "MultiPolygon", "coordinates": [{}, {}]}}}})",
      box(2, 2, 3, 3),
      box(6, 6, 7, 7))});
  EXPECT_EQ(map.columns()->profile(7, 2).slabs, (std::vector<Slab>{{0.0, 1.0, kWall}}));
  EXPECT_EQ(map.columns()->profile(3, 6).slabs, (std::vector<Slab>{{0.0, 1.0, kWall}}));
  EXPECT_EQ(map.objects.profiles.size(), 1U);
}

TEST_F(ObjectsTest, PaintTakesFurnitureAway) {
  const SemanticMap map =
      load({feature(R"("class": "floor", "min_height": 0, "max_height": 0)", box(1, 1, 9, 9))});
  EXPECT_TRUE(map.columns()->profile(4, 4).slabs.empty());
  EXPECT_EQ(map.columns()->profiles.size(), 6U) << "floor as the class list has it";
}

TEST_F(ObjectsTest, EqualProfilesGiveTheEqualFingerprint) {
  const Fingerprint plain = drawn_only();
  EXPECT_EQ(load({}).fingerprint, plain);
  EXPECT_EQ(load({feature(R"("class": "table")", box(4, 4, 6, 6))}).fingerprint, plain)
      << "what the drawing has already";
  const std::string high = R"("class": "table", "min_height": 0.9, "max_height": 1.0)";
  const std::string higher = R"("class": "table", "min_height": 1.1, "max_height": 1.2)";
  const Fingerprint one = load({feature(high, box(2, 2, 6, 4))}).fingerprint;
  EXPECT_NE(one, plain);
  EXPECT_EQ(load({feature(high, box(2, 2, 4, 4)), feature(high, box(4, 2, 6, 4))}).fingerprint,
            one);
  EXPECT_EQ(load({feature(higher, box(2, 2, 6, 4)), feature(high, box(2, 2, 6, 4))}).fingerprint,
            one)
      << "what nothing is left of";
  const Fingerprint two =
      load({feature(high, box(2, 2, 4, 4)), feature(higher, box(5, 5, 7, 7))}).fingerprint;
  EXPECT_EQ(load({feature(higher, box(5, 5, 7, 7)), feature(high, box(2, 2, 4, 4))}).fingerprint,
            two)
      << "features of different places in another order";
  EXPECT_NE(two, one);
}

TEST_F(ObjectsTest, OccupancyAndFreeCellsKnowOnlyProfiles) {
  const SemanticMap map = load({feature(R"("class": "wall", "max_height": 1.0)", box(5, 2, 8, 4)),
                                feature(R"("class": "wall", "min_height": 2.0)", box(2, 2, 4, 4))});
  const Image<std::uint8_t> grey = occupancy_image(*map.columns());
  EXPECT_EQ(grey.at(6, 5), kOccupiedGrey);
  EXPECT_EQ(grey.at(6, 2), kFreeGrey) << "a beam above the robot";
  const CellGrid before = build_cell_grid(testing::columns({"...", "...", "..."}), 1.2);
  EXPECT_EQ(before.free_count(), 9U);
  EXPECT_EQ(build_cell_grid(*map.columns(), 1.2).free_count(),
            std::ranges::count(grey.pixels(), kFreeGrey));
}

TEST_F(ObjectsTest, ThePlansPictureShadesThem) {
  const SemanticMap map = load({feature(R"("class": "wall", "max_height": 1.0)", box(5, 2, 8, 4))});
  const RgbImage image = plan_image(map, *map.columns());
  EXPECT_EQ(image.at(7, 6), object_color(testing::color_of('#')));
  EXPECT_EQ(image.at(1, 1), testing::color_of('#'));
  EXPECT_NE(image.at(7, 6), image.at(1, 1));
}

TEST_F(ObjectsTest, DistortedCopiesCarryThem) {
  load({feature(R"("class": "wall", "max_height": 1.0, "name": "low")", box(5, 2, 8, 4)),
        feature(R"("class": "window", "min_height": 1.5, "above": "none")", box(5, 8, 6, 9)),
        feature(R"("class": "table", "min_height": 0.9, "max_height": 1)", box(2, 5, 3, 6))});
  int i = 0;
  for (const MapAffine& affine :
       {MapAffine{1.2, 0.83, 0.0}, MapAffine{1.0, 1.0, 0.4}, MapAffine{0.5, 0.4, -0.5}}) {
    const SemanticMap expected = *distort(*load_map(folder_.path()), affine);
    const std::filesystem::path out = folder_ / fmt::format("out_{}", i++);
    const Status written = write_distorted(folder_.path(), affine, out);
    ASSERT_TRUE(written) << written.error().message;
    const Result<SemanticMap> loaded = load_map(out);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->fingerprint, expected.fingerprint);
    EXPECT_EQ(loaded->objects.profiles, expected.objects.profiles);
    EXPECT_FALSE(expected.objects.profiles.empty());
  }
}

TEST_F(ObjectsTest, FilesOfQgisAndGeojsonIoAreRead) {
  for (const char* name : {"qgis.geojson", "geojson_io.geojson"}) {
    std::ifstream file(SEMVIEW_SOURCE_DIR "/tests/data/objects/" + std::string(name));
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    write(text);
    const MapCheck check = check_map(folder_.path());
    ASSERT_TRUE(check.map) << name << ": " << text_of(check);
    EXPECT_EQ(text_of(check), "") << name;
    EXPECT_EQ(check.map->objects.features, 2U);
    EXPECT_EQ(check.map->columns()->profile(7, 6).slabs, (std::vector<Slab>{{0.0, 1.1, kWall}}));
    EXPECT_EQ(check.map->columns()->profile(1, 5).slabs[1].z_min_m, 1.4);
  }
}

TEST_F(ObjectsTest, EveryMistakeHasOneLine) {
  const std::string fine = box(5, 2, 8, 4);
  const auto expect = [&](const std::string& properties,
                          const std::string& coordinates,
                          const std::vector<std::string>& words) {
    const std::string text = error(feature(properties, coordinates));
    EXPECT_THAT(text, HasSubstr("objects.geojson: feature 1"));
    EXPECT_EQ(text.find('\n'), std::string::npos);
    for (const std::string& word : words) EXPECT_THAT(text, HasSubstr(word));
  };
  expect(R"("name": "a sill", "class": "windw")",
         fine,
         {"(a sill)", "class windw", "did you mean window"});
  expect("", fine, {"has no property class"});
  expect(R"("class": 7)", fine, {"class is not a text"});
  expect(R"("class": "ceiling")", fine, {"no colour and heights"});
  expect(
      R"("class": "table", "min_height": 2.4)", fine, {"min_height 2.4 is above max_height 0.75"});
  expect(R"("class": "table", "min_height": "0.4")", fine, {"is not a number", "without quotes"});
  expect(R"("class": "table", "max_height": 1e9)", fine, {"out of limits"});
  expect(R"("class": "wall", "min_height": 1, "max_height": 1)", fine, {"no thickness"});
  expect(R"("class": "wall", "above": "wall")", fine, {"names the class itself"});
  expect(R"("class": "wall", "above": "glass")", fine, {"above glass is not listed"});
  expect(R"("class": "wall", "above": "ceiling")", fine, {"which has no heights"});
  expect(R"("class": "wall", "over": ["flor"])", fine, {"over flor is not listed", "floor"});
  expect(R"("class": "wall")", "[[[0, 0], [1, 0], [1, 1]]]", {"a ring has 3 points"});
  expect(R"("class": "wall")", "[[[0, 0], [1, 0], [1, 1], [0, 1]]]", {"begins at", "ends at"});
  expect(R"("class": "wall")",
         "[[[-0.5, 2.2], [0, 2.8], [0, 2.2], [-0.5, 2.8], [-0.5, 2.2]]]",
         {"crosses itself", "(-0.25, 2.50)"});
  expect(R"("class": "wall")", "[[[0, 0], [1, 0], [1, null], [0, 0]]]", {"not two numbers"});
  expect(R"("class": "wall")", "[[[0, 0], [1e300, 0], [1, 1], [0, 0]]]", {"out of limits"});
  expect(R"("class": "wall")", box(500, 500, 510, 510), {"outside the drawing", "x -1.00 to 0.20"});
  expect(R"("class": "wall")",
         "[[[-0.5, 2.5], [-0.49999, 2.5], [-0.49999, 2.50001], [-0.5, 2.5]]]",
         {"not longitude and latitude"});
  EXPECT_THAT(error(R"({"type": "Feature", "properties": {"class": "wall"}, "geometry": )"
                    R"({"type": "LineString", "coordinates": [[0, 0], [1, 1]]}})"),
              HasSubstr("is a LineString"));
  EXPECT_THAT(error(R"({"type": "Polygon", "coordinates": []})"), HasSubstr("is not a Feature"));
}

TEST_F(ObjectsTest, WhatIsWrongWithTheFileItself) {
  EXPECT_THAT(problem("{\n \"type\": \"FeatureCollection\",\n oops", Severity::kError),
              HasSubstr("objects.geojson:3: error: is not JSON"));
  EXPECT_THAT(problem(R"({"type": "FeatureCollection", "features": [1e999]})", Severity::kError),
              HasSubstr("objects.geojson"));
  EXPECT_THAT(problem(R"({"type": "FeatureCollection", "features": [NaN]})", Severity::kError),
              HasSubstr("is not JSON"));
  EXPECT_THAT(problem("[]", Severity::kError), HasSubstr("is not a FeatureCollection"));
  EXPECT_THAT(problem(R"({"type": "FeatureCollection"})", Severity::kError),
              HasSubstr("no list `features`"));
  EXPECT_THAT(problem(std::string(100'000, '['), Severity::kError), HasSubstr("nested deeper"));
  EXPECT_THAT(problem(R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": )"
                      R"({"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}}, "features": []})",
                      Severity::kError),
              HasSubstr("counts in degrees"));
  std::filesystem::remove(folder_ / "objects.geojson");
  const MapCheck check = check_map(folder_.path());
  EXPECT_THAT(to_string(only(check, Severity::kError)), HasSubstr("objects.geojson"));
}

TEST_F(ObjectsTest, WhatMayNotBeMeantIsAWarning) {
  const auto warning = [&](const std::string& properties, const std::string& coordinates) {
    return problem(collection({feature(properties, coordinates)}), Severity::kWarning);
  };
  EXPECT_THAT(warning(R"("class": "wall", "max_height": 3)", box(5, 2, 8, 4)),
              HasSubstr("cut at the ceiling, 2.6"));
  EXPECT_THAT(warning(R"("class": "wall", "min_height": -1, "max_height": 1)", box(5, 2, 8, 4)),
              HasSubstr("cut at the ground"));
  EXPECT_THAT(warning(R"("class": "wall", "max_heigth": 1)", box(5, 2, 8, 4)),
              HasSubstr("did you mean max_height?"));
  EXPECT_THAT(warning(R"("class": "wall")", box(-5, -2, 3, 3)),
              HasSubstr("reaches beyond the drawing"));
  EXPECT_THAT(warning(R"("class": "wall")", box(0, 0, 12, 1)), HasSubstr("only pixels outside"));
  EXPECT_THAT(warning(R"("class": "table", "over": "door")", box(2, 2, 4, 4)),
              HasSubstr("no pixel of the classes"));
  EXPECT_THAT(warning(R"("class": "wall")",
                      "[[[-0.5, 2.51], [0, 2.51], [0, 2.52], [-0.5, 2.52], [-0.5, 2.51]]]"),
              HasSubstr("covers the centre of no pixel"));
  EXPECT_THAT(
      problem(
          collection({R"({"type": "Feature", "properties": {"class": "wall"}, "geometry": null})"}),
          Severity::kWarning),
      HasSubstr("has no geometry"));
  EXPECT_THAT(warning(R"("class": "wall")", "[]"), HasSubstr("has an empty geometry"));
}

TEST_F(ObjectsTest, AClassThatOnlyObjectsUseIsUsed) {
  std::vector<std::string> rows = room();
  for (std::string& row : rows) std::ranges::replace(row, 'T', '.');
  write(collection({feature(R"("class": "table")", box(4, 4, 6, 6))}), rows);
  EXPECT_EQ(text_of(check_map(folder_.path())), "");
}

TEST_F(ObjectsTest, MoreKindsThanAPlanCanHoldAreAnError) {
  std::vector<std::string> features;
  for (int i = 0; i < 260; ++i) {
    const int row = i / 26;
    const double x = -0.9 + 0.03 * (i % 26);
    features.push_back(
        feature(fmt::format(R"("class": "wall", "max_height": {})", 0.1 + 0.005 * i),
                fmt::format("[[[{0}, {2}], [{1}, {2}], [{1}, {3}], [{0}, {3}], [{0}, {2}]]]",
                            x,
                            x + 0.03,
                            2.1 + 0.08 * row,
                            2.18 + 0.08 * row)));
  }
  testing::write_bundle(folder_.path(),
                        std::vector<std::string>(100, std::string(100, '.')),
                        replaced(objects_yaml(), "resolution: 0.1", "resolution: 0.01"));
  testing::write_text(folder_ / "objects.geojson", collection(features));
  const Result<SemanticMap> map = load_map(folder_.path());
  ASSERT_FALSE(map);
  EXPECT_THAT(map.error().message, HasSubstr("260 different kinds of objects"));
}

TEST_F(ObjectsTest, AMeshHasNone) {
  const std::string yaml = replaced(objects_yaml(), "labels: labels.png", "mesh: room.glb");
  testing::write_bundle(folder_.path(), room(), yaml);
  EXPECT_THAT(text_of(check_map(folder_.path())), HasSubstr("objects are given for a mesh"));
}

TEST_F(ObjectsTest, DamagedFilesDoNoMoreThanFail) {
  const std::string whole = collection(
      {feature(R"("class": "wall", "max_height": 1.0, "over": ["floor"])", box(5, 2, 8, 4)),
       feature(R"("class": "table")", box(2, 2, 4, 4))});
  write(whole);
  Rng rng(12, "damage");
  for (int round = 0; round < 400; ++round) {
    std::string damaged = round % 4 == 0 ? whole.substr(0, rng.below(whole.size())) : whole;
    for (int i = 0; i < 3 && !damaged.empty(); ++i) {
      const std::string letters = R"([]{},:"0-9.eE+tfn\ )";
      damaged[rng.below(damaged.size())] = letters[rng.below(letters.size())];
    }
    testing::write_text(folder_ / "objects.geojson", damaged);
    const MapCheck check = check_map(folder_.path());
    EXPECT_TRUE(check.map || check.report.has_errors());
  }
}

}  // namespace
}  // namespace semview::map
