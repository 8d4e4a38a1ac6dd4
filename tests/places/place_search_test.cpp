// SPDX-License-Identifier: Apache-2.0
#include "semview/places/place_search.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "semview/map/semantic_map.hpp"
#include "semview/places/naive_place.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/similarity/plan_likelihood.hpp"
#include "service/small_map.hpp"
#include "support/engine_wish.hpp"

namespace semview::places {
namespace {

/// From within rooms of a metre, floor and ceiling are steep below and above.
const PanoramaCamera kCamera{240, 100, -rad_from_deg(75.0), rad_from_deg(75.0)};

class PlaceSearchTest : public ::testing::Test {
 protected:
  std::shared_ptr<service::Site> open(double eye_height_m) const {
    service::SiteConfig config;
    config.threads = 2;
    config.engine = testing::engine_wish();
    config.profile.eye_height_m = eye_height_m;
    config.profile.camera = kCamera;
    return service::Site::open(map_, config).value();
  }

  static Observation seen(const service::Site& site, const Pose2& pose, double eye_height_m) {
    raycast::PanoramaRequest request;
    request.map_from_robot = pose;
    request.eye_z_m = site.eye_z_m(eye_height_m);
    request.camera = site.profile().camera;
    return {site.map().classes, site.exact_panorama(request).value().labels};
  }

  static similarity::WeightMatrix weights(const service::Site& site) {
    similarity::Vocabulary names;
    for (const std::string& name : site.map().classes.names()) names.push_back({name});
    return similarity::plan_likelihood_weights(names, names).value();
  }

  testing::TemporaryFolder folder_;
  const std::filesystem::path map_ = testing::write_small_map(folder_);
  const Pose2 truth_{0.93, 0.87, rad_from_deg(-52.4)};
};

TEST_F(PlaceSearchTest, FindsAPoseBetweenTheCells) {
  const std::vector floors{open(1.2)};
  const auto search = find_places(floors, seen(*floors[0], truth_, 1.2), weights(*floors[0]), {});
  ASSERT_TRUE(search) << search.error().message;
  ASSERT_FALSE(search->places.empty());
  const Place& best = search->places.front();
  EXPECT_LT(distance_m(best.map_from_robot, truth_), 0.03);
  EXPECT_LT(std::abs(wrap_angle(best.map_from_robot.yaw_rad - truth_.yaw_rad)), rad_from_deg(2.0));
  double all = 0.0;
  for (std::size_t i = 0; i < search->places.size(); ++i) {
    all += search->places[i].probability;
    if (i == 0) continue;
    EXPECT_LE(search->places[i].probability, search->places[i - 1].probability);
  }
  EXPECT_LE(all, 1.0 + 1e-9);
  EXPECT_GE(search->entropy_bits, 0.0);
}

TEST_F(PlaceSearchTest, FindsTheEyeHeightBetweenThoseGiven) {
  const std::vector floors{open(1.1), open(1.5)};
  const auto search = find_places(floors, seen(*floors[0], truth_, 1.36), weights(*floors[0]), {});
  ASSERT_TRUE(search);
  EXPECT_LT(distance_m(search->places.front().map_from_robot, truth_), 0.05);
  EXPECT_NEAR(search->places.front().eye_height_m, 1.36, 0.06);
}

TEST_F(PlaceSearchTest, TurnsTheEyesPlaceIntoTheRobots) {
  const std::vector floors{open(1.2)};
  Observation observation = seen(*floors[0], truth_, 1.2);
  observation.base_from_eye = {0.2, 0.0, 0.0};
  const auto search = find_places(floors, observation, weights(*floors[0]), {});
  ASSERT_TRUE(search);
  const Pose2 eye = search->places.front().map_from_robot * observation.base_from_eye;
  EXPECT_LT(distance_m(eye, truth_), 0.03);
}

TEST_F(PlaceSearchTest, SaysTheSameWithAnyNumberOfThreads) {
  service::SiteConfig config;
  config.engine = testing::engine_wish();
  config.threads = 1;
  config.profile.camera = kCamera;
  const std::vector one{service::Site::open(map_, config).value()};
  const std::vector two{open(1.2)};
  const Observation observation = seen(*one[0], truth_, 1.2);
  const auto a = find_places(one, observation, weights(*one[0]), {});
  const auto b = find_places(two, observation, weights(*two[0]), {});
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->places.size(), b->places.size());
  for (std::size_t i = 0; i < a->places.size(); ++i) {
    EXPECT_EQ(a->places[i].map_from_robot, b->places[i].map_from_robot);
    EXPECT_EQ(a->places[i].probability, b->places[i].probability);
  }
}

TEST_F(PlaceSearchTest, RefusesSettingsOutOfRange) {
  EXPECT_EQ(validate(PlaceSearchConfig{.kappa = 0.0}).error().field, "kappa");
  EXPECT_EQ(validate(PlaceSearchConfig{.grid_kappa = -1.0}).error().field, "grid_kappa");
  EXPECT_EQ(validate(PlaceSearchConfig{.candidates = 0}).error().field, "candidates");
  EXPECT_EQ(validate(PlaceSearchConfig{.most_places = 0}).error().field, "most_places");
  EXPECT_TRUE(validate(PlaceSearchConfig{}));
}

TEST_F(PlaceSearchTest, TheNaiveMatcherTakesTheBestCellAndHeading) {
  const auto site = open(1.2);
  const Pose2 on_grid = PoseGrid::center(GridKey{{9, 8}, 17});
  const auto place = naive_place(*site, seen(*site, on_grid, 1.2));
  ASSERT_TRUE(place && *place);
  EXPECT_EQ(**place, on_grid);
}

}  // namespace
}  // namespace semview::places
