// SPDX-License-Identifier: Apache-2.0
#include "semview/service/site.hpp"

#include <gtest/gtest.h>

#include "semview/cache/lmdb_store.hpp"
#include "semview/cache/view_cache.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/column_renderer.hpp"
#include "semview/raycast/embree_engine.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/raycast/pinhole_renderer.hpp"
#include "service/small_map.hpp"
#include "support/engine_wish.hpp"

namespace semview::service {
namespace {

class SiteTest : public ::testing::Test {
 protected:
  std::shared_ptr<Site> open(const std::filesystem::path& map, SiteConfig config = {}) {
    config.profile.camera = {120, 24, -0.7, 0.7};
    config.threads = 2;
    if (config.engine == "auto") config.engine = testing::engine_wish();
    auto site = Site::open(map, config);
    EXPECT_TRUE(site.has_value()) << (site ? "" : site.error().message);
    return site ? *site : nullptr;
  }

  testing::TemporaryFolder folder_;
  const std::filesystem::path map_ = testing::write_small_map(folder_);
  const std::vector<CellIndex> cells_ = {{0, 8}, {10, 8}, {0, 8}};
};

TEST_F(SiteTest, ServesCellsFromCastThenMemory) {
  const auto site = open(map_);
  const auto first = site->views().views(cells_);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->origins, (ViewOrigins{0, 0, 2}));
  const auto second = site->views().views(cells_);
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(second->origins, (ViewOrigins{2, 0, 0}));
  const auto engine = site->engine_views().views(cells_);
  ASSERT_TRUE(engine.has_value());
  for (std::size_t i = 0; i < cells_.size(); ++i) EXPECT_EQ(*second->views[i], *engine->views[i]);
}

TEST_F(SiteTest, AnEyeAboveTheCeilingIsRefused) {
  SiteConfig config;
  config.profile.camera = {120, 24, -0.7, 0.7};
  config.profile.eye_height_m = 2.7;
  const auto site = Site::open(map_, config);
  ASSERT_FALSE(site.has_value());
  EXPECT_EQ(site.error().field, "--eye-height");
  EXPECT_NE(site.error().hint.find("map check"), std::string::npos);
}

TEST_F(SiteTest, ARestartFindsItsViewsOnDisk) {
  SiteConfig config;
  config.cache_directory = folder_.path() / "cache";
  ASSERT_TRUE(open(map_, config)->views().views(cells_).has_value());
  const auto again = open(map_, config)->views().views(cells_);
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->origins, (ViewOrigins{0, 2, 0}));
}

TEST_F(SiteTest, AChangedMapMeetsNoOldView) {
  SiteConfig config;
  config.cache_directory = folder_.path() / "cache";
  const auto old_site = open(map_, config);
  ASSERT_TRUE(old_site->views().views(cells_).has_value());
  const auto new_site = open(testing::write_small_map(folder_, "two_rooms", "2.0"), config);
  EXPECT_NE(new_site->map().fingerprint, old_site->map().fingerprint);
  const auto views = new_site->views().views(cells_);
  ASSERT_TRUE(views.has_value());
  EXPECT_EQ(views->origins.cast, 2U);
}

TEST_F(SiteTest, ACellInAWallHasTheViewOfItsNeighbourAndOneFarOutsideNone) {
  const auto site = open(map_);
  // Rows of the plan count from the top; the lowest is at y = 0.2 m: the left wall is ix -5.
  const std::vector<CellIndex> cells = {{-5, 9}, {-4, 9}, {500, 500}};
  ASSERT_FALSE(site->cells().has_eye(cells[0]));
  ASSERT_TRUE(site->cells().has_eye(cells[1]));
  const auto batch = site->views().views(cells);
  ASSERT_TRUE(batch.has_value());
  EXPECT_EQ(batch->views[0], batch->views[1]);
  EXPECT_EQ(batch->views[2], nullptr);
  EXPECT_EQ(batch->origins.total(), 1U);
}

TEST_F(SiteTest, WhereEnginesDifferEmbreeCastsTheExactViewsOfBoth) {
  SiteConfig config;
  config.engine = "columns";
  const auto columns = open(map_, config);
  config.engine = "embree";
  const auto embree = open(map_, config);
  const auto expect_embree = [&](double x_m, double y_m, double z_m, const std::string& reason) {
    const raycast::PanoramaRequest request{{x_m, y_m, 0.4}, z_m, {240, 30, -0.6, 0.6}, {}};
    EXPECT_EQ(columns->panorama_engine(request).name, "embree");
    EXPECT_EQ(columns->panorama_engine(request).reason, reason);
    EXPECT_EQ(embree->panorama_engine(request).reason, "it was asked for");
    const auto one = columns->exact_panorama(request);
    const auto other = embree->exact_panorama(request);
    ASSERT_TRUE(one && other);
    EXPECT_EQ(one->labels, other->labels);
    EXPECT_EQ(one->ranges_m, other->ranges_m);
  };
  expect_embree(-0.45, 1.05, 1.2, "the eye is inside a wall, and such views are cast by Embree");
  expect_embree(0.95, 1.05, 0.72, "the eye is inside a table, and such views are cast by Embree");
  for (const double z_m : {2.6, 3.0}) {
    expect_embree(
        0.03, 0.91, z_m, "the eye is above the ceiling, and such views are cast by Embree");
  }
  // Over the table, and past the plan, a cell could have its eye for all that engines care.
  EXPECT_EQ(columns->panorama_engine({{0.95, 1.05, 0.4}, 1.2, {}, {}}).name, "columns");
  EXPECT_EQ(columns->panorama_engine({{50.0, 50.0, 0.4}, 1.2, {}, {}}).name, "columns");
  EXPECT_EQ(columns->pinhole_engine().name, "embree");
  EXPECT_EQ(columns->pinhole_engine().reason, "pinhole views are cast by Embree");
}

TEST_F(SiteTest, ExactViewsAreTheRenderersAndKeepToTheLimit) {
  const auto site = open(map_);
  raycast::PanoramaRequest request;
  request.map_from_robot = {0.03, 0.91, 0.4};
  request.eye_z_m = site->eye_z_m(1.1);
  request.camera = {240, 30, -0.6, 0.6};
  const auto panorama = site->exact_panorama(request);
  ASSERT_TRUE(panorama.has_value());
  if (testing::plan_engine() == "embree") {
    EXPECT_EQ(panorama->labels, raycast::render_panorama(site->scene(), request).labels);
  } else {
    const auto columns = raycast::ColumnScene::build(*site->map().columns());
    EXPECT_EQ(panorama->labels, raycast::render_panorama(columns, request).labels);
  }
  request.map_from_robot.x_m = std::nan("");
  EXPECT_EQ(site->exact_panorama(request).error().code, ErrorCode::kInvalidArgument);

  raycast::PinholeRequest pinhole;
  pinhole.map_from_camera = level_camera({0.03, 0.91, 0.4}, 1.2);
  pinhole.camera = {40, 30, 40.0, 40.0, 20.0, 15.0};
  const auto view = site->exact_pinhole(pinhole);
  ASSERT_TRUE(view.has_value());
  EXPECT_EQ(view->labels, raycast::render_pinhole(site->scene(), pinhole).labels);
  pinhole.camera.columns = 4000;
  pinhole.camera.rows = 4000;
  EXPECT_EQ(site->exact_pinhole(pinhole).error().code, ErrorCode::kResourceExhausted);
}

TEST_F(SiteTest, SaysWhichEngineCastsAndWhy) {
  EXPECT_EQ(open(map_)->engine().name, testing::plan_engine());
  SiteConfig config;
  config.engine = "embree";
  const auto site = open(map_, config);
  EXPECT_EQ(site->engine().name, "embree");
  EXPECT_EQ(site->engine().version, raycast::EmbreeEngine::kVersion);
  EXPECT_EQ(site->engine().reason, "it was asked for");
}

TEST_F(SiteTest, ViewsOfOneEngineAreNoneOfTheOthers) {
  SiteConfig config;
  config.cache_directory = folder_.path() / "cache";
  for (const char* engine : {"embree", "columns"}) {
    config.engine = engine;
    const auto first = open(map_, config)->views().views(cells_);
    ASSERT_TRUE(first.has_value());
    EXPECT_EQ(first->origins, (ViewOrigins{0, 0, 2})) << engine;
    const auto again = open(map_, config)->views().views(cells_);
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(again->origins, (ViewOrigins{0, 2, 0})) << engine;
  }
}

TEST_F(SiteTest, BothEnginesSeeTheSame) {
  SiteConfig config;
  config.engine = "embree";
  const auto embree = open(map_, config)->views().views(cells_);
  config.engine = "columns";
  const auto columns = open(map_, config)->views().views(cells_);
  ASSERT_TRUE(embree.has_value() && columns.has_value());
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    EXPECT_EQ(*embree->views[i], *columns->views[i]);
  }
}

TEST_F(SiteTest, SitesShareTheirTiers) {
  SiteConfig config;
  config.engine = testing::engine_wish();
  config.profile.camera = {120, 24, -0.7, 0.7};
  config.cache_directory = folder_.path() / "cache";
  const auto tiers = SharedTiers::open(config);
  ASSERT_TRUE(tiers.has_value());
  const auto first = Site::open(map_, "", config, *tiers);
  const auto second = Site::open(map_, "another", config, *tiers);
  ASSERT_TRUE(first.has_value());
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ((*first)->id(), "two_rooms");
  EXPECT_EQ((*second)->id(), "another");
  ASSERT_TRUE((*first)->views().views(cells_).has_value());
  const auto batch = (*second)->views().views(cells_);
  ASSERT_TRUE(batch.has_value());
  EXPECT_EQ(batch->origins.memory, 2U) << "one map by two names has one keyspace";
}

TEST_F(SiteTest, WrongSettingsNameTheirOption) {
  SiteConfig config;
  config.engine = "magic";
  EXPECT_EQ(Site::open(map_, config).error().field, "--engine");
  config = {};
  config.profile.camera.columns = 100;
  EXPECT_EQ(Site::open(map_, config).error().field, "--columns");
  config = {};
  config.profile.eye_height_m = 0.0;
  EXPECT_EQ(Site::open(map_, config).error().field, "--eye-height");
  EXPECT_FALSE(Site::open(folder_.path() / "nowhere", {}).has_value());
}

}  // namespace
}  // namespace semview::service
