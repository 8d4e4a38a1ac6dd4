// SPDX-License-Identifier: Apache-2.0
/// The drives of lost_calibration.hpp.
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "client/robot/localizer.hpp"
#include "lost_calibration.hpp"
#include "plan_drawing.hpp"
#include "semview/core/random.hpp"
#include "semview/localization/initialization.hpp"
#include "semview/localization/odometry_motion_model.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/service/site.hpp"
#include "semview/similarity/similarity_score_source.hpp"
#include "trial.hpp"
#include "world.hpp"

namespace semview::paper2017 {
namespace {

using localization::HeadingStrategy;

/// Starts and jumps nearer than this are no other place.
constexpr double kElsewhere_m = 3.0;

/// The order in which a drive visits a world's stops: once, with at most one jump.
struct Visits {
  std::vector<std::size_t> stops;
  std::size_t jump = 0;  ///< the visit before which the robot is carried away; 0: never
};

std::size_t place_elsewhere(const RowWorld& world, std::size_t from, Rng& rng) {
  std::vector<std::size_t> far;
  for (std::size_t i = 0; i + 1 < world.truth.size(); ++i) {
    if (distance_m(world.truth[i], world.truth[from]) > kElsewhere_m) far.push_back(i);
  }
  return far[static_cast<std::size_t>(rng.uniform() * static_cast<double>(far.size()))];
}

Visits plan_visits(const RowWorld& world, Situation situation, Rng& rng) {
  Visits visits;
  for (std::size_t i = 0; i < world.truth.size(); ++i) visits.stops.push_back(i);
  if (situation != Situation::kKidnapped) return visits;
  // After three to seven stops; on from there to the end of the way.
  visits.jump = 3 + static_cast<std::size_t>(rng.uniform() * 5.0);
  const std::size_t landing = place_elsewhere(world, visits.jump, rng);
  visits.stops.resize(visits.jump);
  for (std::size_t i = landing; i < world.truth.size(); ++i) visits.stops.push_back(i);
  return visits;
}

localization::ParticleSet start_of(const RowWorld& world,
                                   Situation situation,
                                   const Visits& visits,
                                   Rng& rng) {
  if (situation == Situation::kGlobal) {
    return localization::uniform_particles(world.free_cells, kGlobalParticles, rng);
  }
  const std::size_t first = visits.stops.front();
  const std::size_t believed =
      situation == Situation::kWrongStart ? place_elsewhere(world, first, rng) : first;
  return localization::gaussian_particles(
      world.truth[believed], 0.25, rad_from_deg(5.0), kLocalParticles, rng);
}

robot::LocalizerConfig config_of(HeadingStrategy heading, Situation situation) {
  robot::LocalizerConfig config;
  config.heading = heading;
  // As `semview localize` has it: a heading that nobody knows is not found by odometry.
  if (heading == HeadingStrategy::kOdometry && situation == Situation::kGlobal) {
    config.heading = HeadingStrategy::kCompass;
  }
  if (heading == HeadingStrategy::kCombined) config.filter.compass = {1.0, kPi};
  return config;
}

Status drive(const RowWorld& world,
             Situation situation,
             HeadingStrategy heading,
             ScoreSource& source,
             std::uint64_t seed,
             LostStop common,
             std::vector<LostStop>& stops) {
  Rng rng(seed, "situation");
  const Visits visits = plan_visits(world, situation, rng);
  robot::Localizer localizer(config_of(heading, situation),
                             source,
                             std::make_shared<const localization::OdometryMotionModel>(
                                 localization::OdometryMotionConfig{}),
                             start_of(world, situation, visits, rng),
                             seed);
  localizer.know_free_cells(world.free_cells);
  Pose2 odom_from_robot;
  for (std::size_t i = 0; i < visits.stops.size(); ++i) {
    const std::size_t stop = visits.stops[i];
    if (i > 0) {
      // Somebody who is carried away measures the step that was to come.
      const std::size_t from = visits.stops[i - 1];
      odom_from_robot =
          odom_from_robot * (inverse(world.odometry[from]) * world.odometry[from + 1]);
    }
    SEMVIEW_TRY(
        const robot::FrameReport report,
        localizer.advance({static_cast<double>(i), odom_from_robot, world.observations[stop]}));
    if (!report.lost_features) continue;
    common.stop = static_cast<int>(i) + 1;
    common.since_kidnap =
        visits.jump > 0 && i >= visits.jump ? static_cast<int>(i - visits.jump) + 1 : 0;
    common.error_m = distance_m(report.estimate.map_from_robot, world.truth[stop]);
    common.features = *report.lost_features;
    stops.push_back(common);
  }
  return {};
}

Result<std::shared_ptr<service::Site>> open_plan(const World& world,
                                                 std::uint64_t seed,
                                                 const std::filesystem::path& plans) {
  const std::filesystem::path directory = plans / fmt::format("lost{}", seed);
  SEMVIEW_TRY_STATUS(draw_plan(world.layout, PlanConfig{}, seed, directory));
  service::SiteConfig config;
  config.threads = 1;
  config.profile.camera = {120, 38, -rad_from_deg(38.0), rad_from_deg(38.0)};
  return service::Site::open(directory, config);
}

Result<std::vector<LostStop>> drive_world(const LostSettings& settings, std::uint64_t seed) {
  std::vector<LostStop> stops;
  std::shared_ptr<service::Site> site;
  for (const double noise_level : settings.noise_levels) {
    WorldConfig config;
    config.noise.level = noise_level;
    const World made = make_world(config, WorldSeeds::all(seed));
    if (!site) {
      SEMVIEW_TRY(site, open_plan(made, seed, settings.plans));
    }
    RowWorld world = cut_world(made, *find_row("unmodified"), site->profile().camera);
    world.free_cells = site->cells().free_cells();
    world.map_classes = site->map().classes;
    similarity::SimilarityScoreSource source(
        site->views(), world.map_classes, settings.weights, site->pool());
    std::uint64_t drives = 0;
    for (const Situation situation : {Situation::kKnownStart,
                                      Situation::kWrongStart,
                                      Situation::kGlobal,
                                      Situation::kKidnapped}) {
      for (const HeadingStrategy heading :
           {HeadingStrategy::kOdometry, HeadingStrategy::kCompass, HeadingStrategy::kCombined}) {
        for (int run = 1; run <= settings.runs; ++run) {
          LostStop common;
          common.world = seed;
          common.noise_level = noise_level;
          common.situation = situation;
          common.run = run;
          SEMVIEW_TRY_STATUS(drive(world,
                                   situation,
                                   heading,
                                   source,
                                   settings.seed * 1'000'003 + seed * 1009 + ++drives,
                                   common,
                                   stops));
        }
      }
    }
  }
  return stops;
}

}  // namespace

Result<std::vector<LostStop>> drive_all(const LostSettings& settings, ThreadPool& pool) {
  std::vector<std::optional<Result<std::vector<LostStop>>>> worlds(settings.worlds.size());
  pool.parallel_for(worlds.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      worlds[i] = drive_world(settings, settings.worlds[i]);
    }
  });
  std::vector<LostStop> all;
  for (auto& world : worlds) {
    SEMVIEW_TRY(std::vector<LostStop> stops, *std::move(world));
    all.insert(all.end(), stops.begin(), stops.end());
  }
  return all;
}

}  // namespace semview::paper2017
