// SPDX-License-Identifier: Apache-2.0
// The columns caster against Embree on the extruded plan.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "raycast/column_comparison.hpp"
#include "semview/map/semantic_map.hpp"
#include "support/paths.hpp"

namespace semview::raycast {
namespace {

TEST(ColumnsTest, AnyPlanLooksAsEmbreeSeesIt) {
  const ColumnComparison comparison = compare_on_any_plans(1, 60, 4);
  EXPECT_EQ(comparison.wrong, 0) << comparison;
  // One in a million is the limit of ties; the slow test looks at enough pixels to hold them to it.
  EXPECT_LE(comparison.ties, 3) << comparison;
  EXPECT_GT(comparison.pixels, 2'000'000);
}

/// Casts `count` views from places like cells' centres by both.
void compare_on_cells(const map::ColumnMap& plan,
                      Rng& rng,
                      int count,
                      ColumnComparison& comparison) {
  const map::TriangleMesh mesh = map::extrude(plan);
  const Scene scene = std::move(*Scene::build(mesh, {true}));
  const ColumnScene columns = ColumnScene::build(plan);
  const map::Bounds bounds = plan.bounds();
  for (int views = 0; views < count;) {
    // As cells are: centres of 10 cm, on pixel edges of some plans.
    const double x = std::round(rng.uniform(bounds.min_x_m, bounds.max_x_m) * 10) / 10 + 0.05;
    const double y = std::round(rng.uniform(bounds.min_y_m, bounds.max_y_m) * 10) / 10 + 0.05;
    const ColumnProfile* profile = plan.at(x, y);
    const double eye = plan.ground_height_m + 1.2;
    if (profile == nullptr || profile->outside || profile->reaches_into(eye - 0.1, eye + 0.1)) {
      continue;
    }
    compare_casters(mesh, scene, columns, {{x, y, 0.0}, eye, {}, {}}, comparison);
    ++views;
  }
}

TEST(ColumnsTest, ShippedPlansLookAsEmbreeSeesThem) {
  ColumnComparison comparison;
  for (const char* name : {"duplex_level1", "duplex_level2", "largebuilding_level1", "tutorial"}) {
    const auto map = map::load_map(std::string(SEMVIEW_SOURCE_DIR "/maps/") + name);
    ASSERT_TRUE(map);
    Rng rng(1, name);
    compare_on_cells(*map->columns(), rng, 15, comparison);
  }
  EXPECT_EQ(comparison.wrong, 0) << comparison;
  EXPECT_LE(comparison.ties, comparison.pixels / 1'000'000) << comparison;
  EXPECT_LE(comparison.worst_range_m, 1e-3);
}

/// Triangles of several classes with any heights, and all sills of the house higher.
std::string any_objects(Rng& rng) {
  std::string features =
      R"({"type": "Feature", "properties": {"class": "windowpane", "min_height": 1.3, "over": "windowpane"},
          "geometry": {"type": "Polygon", "coordinates": [[[-1, -1], [4, -1], [4, 9], [-1, 9], [-1, -1]]]}})";
  for (const char* name : {"cabinet", "table", "wall", "windowpane", "bookcase", "door", "rug"}) {
    for (int i = 0; i < 3; ++i) {
      const double x = rng.uniform(0.5, 7.0);
      const double y = rng.uniform(0.5, 5.0);
      const double low = rng.uniform(0.0, 1.0);
      features += fmt::format(
          R"(, {{"type": "Feature", "properties": {{"class": "{}", "min_height": {}, "max_height": {}}},
             "geometry": {{"type": "Polygon", "coordinates": [[[{}, {}], [{}, {}], [{}, {}], [{}, {}]]]}}}})",
          name,
          low,
          low + rng.uniform(0.05, 1.4),
          x,
          y,
          x + rng.uniform(0.1, 0.9),
          y,
          x,
          y + rng.uniform(0.1, 0.9),
          x,
          y);
    }
  }
  return fmt::format(R"({{"type": "FeatureCollection", "features": [{}]}})", features);
}

TEST(ColumnsTest, PlansWithObjectsLookAsEmbreeSeesThem) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("semview_objects_{}", ::getpid());
  std::filesystem::copy(SEMVIEW_SOURCE_DIR "/maps/tutorial", folder);
  Rng rng(1, "objects");
  std::ofstream(folder / "objects.geojson") << any_objects(rng);
  std::ifstream drawn(SEMVIEW_SOURCE_DIR "/maps/tutorial/map.yaml");
  std::string yaml{std::istreambuf_iterator<char>(drawn), {}};
  yaml.replace(yaml.find("  ground:"), 0, "  objects: objects.geojson\n");
  std::ofstream(folder / "map.yaml") << yaml;
  const auto map = map::load_map(folder);
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_GT(map->objects.profiles.size(), 15U);
  ColumnComparison comparison;
  compare_on_cells(*map->columns(), rng, 30, comparison);
  EXPECT_EQ(comparison.wrong, 0) << comparison;
  EXPECT_LE(comparison.ties, 1 + comparison.pixels / 1'000'000) << comparison;
  EXPECT_LE(comparison.worst_range_m, 1e-3);
}

TEST(ColumnsTest, RunsAreThoseOfThePixels) {
  Rng rng(2, "columns");
  for (int i = 0; i < 40; ++i) {
    const map::ColumnMap plan = any_plan(rng);
    const ColumnScene scene = ColumnScene::build(plan);
    const PanoramaRequest request = any_request(rng, plan);
    const ColumnView labels = render_column_view(scene, request, false);
    const ColumnView ranges = render_column_view(scene, request, true);
    EXPECT_FALSE(labels.has_ranges());
    EXPECT_TRUE(ranges.has_ranges());
    EXPECT_EQ(labels, ColumnView::from_labels(ranges.to_labels()));
    const Panorama pixels = render_panorama(scene, request);
    EXPECT_EQ(pixels.labels, ranges.to_labels());
    const RangeImage rebuilt_m = ranges.to_ranges(request.camera);
    for (int r = 0; r < request.camera.rows; ++r) {
      for (int c = 0; c < request.camera.columns; ++c) {
        ASSERT_FLOAT_EQ(pixels.ranges_m.at(r, c), rebuilt_m.at(r, c));
      }
    }
    // Canonical, as whoever stores or receives them checks.
    EXPECT_TRUE(ColumnView::from_runs(request.camera.rows,
                                      {ranges.first_run().begin(), ranges.first_run().end()},
                                      {ranges.runs().begin(), ranges.runs().end()},
                                      {ranges.planes().begin(), ranges.planes().end()}));
  }
}

/// All floor under a ceiling of 2.5 m.
map::ColumnMap hall() {
  map::ColumnMap plan;
  plan.resolution_m = 0.1;
  plan.ceiling = map::Ceiling{kPlanCeiling, 2.5};
  plan.profiles = {ColumnProfile{true, false, kNoHit, {}},
                   ColumnProfile{false, false, kPlanFloor, {}},
                   {false, false, kPlanFloor, {{0.0, 2.5, kPlanWall}}}};
  plan.profile_of_pixel = Image<std::uint8_t>(300, 300, 1);
  for (int c = 100; c < 200; ++c) plan.profile_of_pixel.at(100, c) = 2;
  return plan;
}

TEST(ColumnsTest, TheCeilingHidesWhatIsUnderItFromAbove) {
  const ColumnScene scene = ColumnScene::build(hall());
  const Panorama panorama = render_panorama(scene, {{15.0, 15.0, 0.0}, 4.0, {}, {}});
  for (int c = 0; c < 360; ++c) {
    EXPECT_EQ(panorama.labels.at(0, c), kNoHit);
    EXPECT_EQ(panorama.labels.at(89, c), kPlanCeiling);
    const double elevation = PanoramaCamera{}.elevation_rad(89);
    EXPECT_NEAR(panorama.ranges_m.at(89, c), 1.5 / -std::sin(elevation), 1e-5);
  }
}

TEST(ColumnsTest, TheGroundHidesWhatIsAboveItFromBelow) {
  const ColumnScene scene = ColumnScene::build(hall());
  const Panorama panorama = render_panorama(scene, {{15.0, 15.0, 0.0}, -1.0, {}, {}});
  for (int c = 0; c < 360; ++c) {
    EXPECT_EQ(panorama.labels.at(0, c), kPlanFloor);
    EXPECT_EQ(panorama.labels.at(89, c), kNoHit);
  }
}

TEST(ColumnsTest, FromTooFarAwayNothingIsSeen) {
  const ColumnScene scene = ColumnScene::build(hall());
  const ColumnView view = render_column_view(scene, {{-9e5, 15.0, 0.0}, 1.0, {}, {}}, true);
  EXPECT_EQ(view.runs().size(), 360U);
  EXPECT_EQ(view.runs().front().label, kNoHit);
}

}  // namespace
}  // namespace semview::raycast
