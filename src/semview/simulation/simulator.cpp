// SPDX-License-Identifier: Apache-2.0
#include "semview/simulation/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "semview/io/run_log.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/raycast/engine_choice.hpp"
#include "semview/raycast/mesh_cell_grid.hpp"
#include "semview/raycast/scene.hpp"
#include "semview/simulation/free_space.hpp"
#include "semview/simulation/indoors.hpp"
#include "semview/view/view_profile.hpp"

namespace semview::simulation {
namespace {

constexpr double kOdometryPeriod_s = 0.1;
constexpr double kDoorReach_m = 0.35;

/// The moments of a drive that are written down.
struct Moments {
  std::vector<io::StampedPose2> frames;
  std::vector<io::StampedPose2> odometry;     ///< true poses at the odometry's stamps
  std::vector<io::StampedPose2> groundtruth;  ///< both
  double way_m = 0.0;
};

/// The building that the robot is in, and its way through it.
struct Stage {
  raycast::EngineChoice choice;
  Moments moments;
};

WorldConfig scaled(WorldConfig config, double level) {
  config.height_error_m *= level;
  config.missing_share = std::min(1.0, config.missing_share * level);
  return config;
}

Moments pick_moments(const std::vector<io::StampedPose2>& drive, const SimulationConfig& config) {
  Moments moments;
  const auto period =
      static_cast<std::size_t>(std::lround(kOdometryPeriod_s / config.drive.tick_s));
  double since_frame_m = std::numeric_limits<double>::infinity();  // the first pose is a frame
  for (std::size_t tick = 0; tick < drive.size(); ++tick) {
    if (tick > 0) {
      const double step_m = distance_m(drive[tick - 1].pose, drive[tick].pose);
      since_frame_m += step_m;
      moments.way_m += step_m;
    }
    const bool done = static_cast<int>(moments.frames.size()) == config.frames;
    const bool frame = !done && since_frame_m >= config.frame_distance_m;
    const bool odometry = tick % period == 0 || tick + 1 == drive.size();
    if (frame) {
      moments.frames.push_back(drive[tick]);
      since_frame_m = 0.0;
    }
    if (odometry) moments.odometry.push_back(drive[tick]);
    if (frame || odometry) moments.groundtruth.push_back(drive[tick]);
    if (done && odometry) break;  // the last frame lies between two odometry samples
  }
  return moments;
}

/// Plans and drives; also measures how near the robot comes to things.
Result<Moments> drive_through(const map::CellGrid& grid,
                              const SimulationConfig& config,
                              SimulationReport& report) {
  const double length_m = config.frames * config.frame_distance_m;
  TourConfig tour = config.tour;
  // Smoothing and the robot's own steering cut corners.
  tour.length_m = 1.3 * length_m + 2.0;
  Rng rng(config.seed, "path");
  const FreeSpace space(grid);
  SEMVIEW_TRY(const std::vector<Point2> line, plan_tour(space, tour, rng));
  Moments moments = pick_moments(drive(line, length_m + 0.5, config.drive), config);
  if (moments.frames.empty()) {
    return fail(ErrorCode::kFailedPrecondition, "there is no room to drive");
  }
  report.min_clearance_m = FreeSpace::kHorizon_m;
  for (const io::StampedPose2& sample : moments.groundtruth) {
    report.min_clearance_m =
        std::min(report.min_clearance_m, space.clearance_m(sample.pose.x_m, sample.pose.y_m));
  }
  return moments;
}

/// Chooses what casts a building, which is `map` or, where there is one, its changed `plan`.
Result<raycast::EngineChoice> engine_for(std::string_view name,
                                         const map::SemanticMap& map,
                                         const map::ColumnMap* plan,
                                         const map::CellGrid& grid,
                                         raycast::Scene scene,
                                         const CameraConfig& camera) {
  const ViewProfile profile{
      {camera.columns, camera.rows, camera.elevation_min_rad, camera.elevation_max_rad},
      camera.height_m};
  ThreadPool pool;
  return raycast::choose_engine(name,
                                {map.id,
                                 map.classes,
                                 plan,
                                 std::make_shared<const raycast::Scene>(std::move(scene)),
                                 grid,
                                 map.ground_height_m},
                                profile,
                                pool);
}

Result<Stage> set_stage(const map::SemanticMap& map,
                        const SimulationConfig& config,
                        SimulationReport& report) {
  const CameraConfig& camera = config.camera;
  const double eye_z_m = map.ground_height_m + camera.height_m;
  if (map.columns() == nullptr) {
    SEMVIEW_TRY(raycast::Scene scene, raycast::Scene::build(map));
    SEMVIEW_TRY(const map::CellGrid grid,
                raycast::build_cell_grid(scene, map.ground_height_m, camera.height_m));
    SEMVIEW_TRY(raycast::EngineChoice choice,
                engine_for(config.engine, map, nullptr, grid, std::move(scene), camera));
    SEMVIEW_TRY(Moments moments,
                drive_through(indoor_cells(grid, *choice.engine, eye_z_m), config, report));
    return Stage{std::move(choice), std::move(moments)};
  }
  Rng rng(config.seed, "layout");
  World world = vary_plan(map, scaled(config.world, config.noise_level), rng);
  report.objects = world.objects;
  report.furniture = world.furniture;
  report.missing = world.missing;
  const map::CellGrid grid = map::build_cell_grid(world.plan, camera.height_m);
  SEMVIEW_TRY(raycast::Scene shut, raycast::Scene::build(map::extrude(world.plan)));
  SEMVIEW_TRY(raycast::EngineChoice choice,
              engine_for(config.engine, map, &world.plan, grid, std::move(shut), camera));
  SEMVIEW_TRY(Moments moments,
              drive_through(indoor_cells(grid, *choice.engine, eye_z_m), config, report));
  std::vector<Point2> way;
  for (const io::StampedPose2& sample : moments.groundtruth) {
    way.push_back({sample.pose.x_m, sample.pose.y_m});
  }
  report.opened_doors = open_doors(world.plan, way, kDoorReach_m, camera.height_m);
  SEMVIEW_TRY(raycast::Scene scene, raycast::Scene::build(map::extrude(world.plan)));
  // The engine of the shut building: open doors are no reason to check it again.
  SEMVIEW_TRY(const raycast::EngineChoice opened,
              engine_for(choice.engine->name(), map, &world.plan, grid, std::move(scene), camera));
  choice.engine = opened.engine;
  return Stage{std::move(choice), std::move(moments)};
}

/// Columns of a full turn that the camera shows: [first, last).
struct Field {
  int first = 0;
  int last = 0;
};

Field field_of(const CameraConfig& camera) {
  const double shown = camera.columns * camera.azimuth_width_rad / kTwoPi;
  const int half = std::clamp(static_cast<int>(std::lround(0.5 * shown)), 1, camera.columns / 2);
  return {camera.columns / 2 - half, camera.columns / 2 + half};
}

LabelImage cut_out(const LabelImage& labels, const Field& field) {
  LabelImage cut(labels.rows(), field.last - field.first);
  for (int r = 0; r < labels.rows(); ++r) {
    for (int c = field.first; c < field.last; ++c) {
      const ClassId label = labels.at(r, c);
      // A network has no word for "nothing there".
      cut.at(r, c - field.first) = label == kNoHit ? kUnknown : label;
    }
  }
  return cut;
}

io::ObservationSetup setup_of(const map::SemanticMap& world, const CameraConfig& camera) {
  const Field field = field_of(camera);
  PartialPanorama panorama;
  panorama.azimuth_left_rad = kPi - field.first * kTwoPi / camera.columns;
  panorama.azimuth_right_rad = kPi - field.last * kTwoPi / camera.columns;
  panorama.elevation_min_rad = camera.elevation_min_rad;
  panorama.elevation_max_rad = camera.elevation_max_rad;
  panorama.position_m = {0.0, 0.0, camera.height_m};
  io::ObservationSetup setup;
  setup.classes = world.classes;
  setup.camera = panorama;
  return setup;
}

/// Takes the frames; returns the share of labels that are wrong.
Result<double> record_frames(const map::SemanticMap& world,
                             const Stage& stage,
                             const SimulationConfig& config,
                             io::RunLogWriter& log) {
  const std::vector<io::StampedPose2>& frames = stage.moments.frames;
  const CameraConfig& camera = config.camera;
  const Field field = field_of(camera);
  const LabelGeometry geometry{kTwoPi / camera.columns,
                               (camera.elevation_max_rad - camera.elevation_min_rad) / camera.rows,
                               field.last - field.first == camera.columns};
  Rng camera_rng(config.seed, "camera");
  const double error_m = config.noise_level * camera.height_error_m;
  const double mounting_error_m = 0.75 * error_m * camera_rng.uniform(-1.0, 1.0);
  std::uint64_t labelled = 0;
  std::uint64_t wrong = 0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    raycast::PanoramaRequest request;
    request.map_from_robot = frames[k].pose;
    request.eye_z_m = world.ground_height_m + camera.height_m + mounting_error_m +
                      0.25 * error_m * camera_rng.uniform(-1.0, 1.0);
    request.camera = {
        camera.columns, camera.rows, camera.elevation_min_rad, camera.elevation_max_rad};
    SEMVIEW_TRY_STATUS(raycast::validate(request));
    const LabelImage truth = cut_out(stage.choice.engine->panorama(request).labels, field);
    Rng label_rng(config.seed, "segmentation", k);
    const LabelImage seen = add_segmentation_noise(
        truth, geometry, world.classes.size(), config.segmentation, config.noise_level, label_rng);
    for (std::size_t p = 0; p < truth.pixels().size(); ++p) {
      if (seen.pixels()[p] == kUnknown) continue;
      ++labelled;
      wrong += seen.pixels()[p] != truth.pixels()[p] ? 1 : 0;
    }
    SEMVIEW_TRY_STATUS(log.add_frame(frames[k].stamp_s, seen));
  }
  return labelled == 0 ? 0.0 : static_cast<double>(wrong) / static_cast<double>(labelled);
}

tl::unexpected<Error> out_of_range(const char* field, double value, const char* expected) {
  return fail(Error{
      ErrorCode::kInvalidArgument, fmt::format("{} {} is not {}", field, value, expected), field});
}

}  // namespace

Status validate(const SimulationConfig& config) {
  if (config.frames < 1 || config.frames > 100000) {
    return out_of_range("frames", config.frames, "in 1..100000");
  }
  if (!(config.frame_distance_m >= 0.02 && config.frame_distance_m <= 100.0)) {
    return out_of_range("frame_distance_m", config.frame_distance_m, "in [0.02, 100]");
  }
  if (!(config.frames * config.frame_distance_m <= 10000.0)) {
    return out_of_range("frames", config.frames, "a drive of at most 10 km");
  }
  if (!(config.noise_level >= 0.0 && config.noise_level <= 5.0)) {
    return out_of_range("noise_level", config.noise_level, "in [0, 5]");
  }
  if (!(config.world.missing_share >= 0.0 && config.world.missing_share <= 1.0)) {
    return out_of_range("missing_share", config.world.missing_share, "in [0, 1]");
  }
  SEMVIEW_TRY_STATUS(raycast::check_engine_name(config.engine));
  const CameraConfig& camera = config.camera;
  if (!(camera.azimuth_width_rad > 0.0 && camera.azimuth_width_rad <= kTwoPi + 1e-9)) {
    return out_of_range(
        "azimuth_width", deg_from_rad(camera.azimuth_width_rad), "in (0, 360] degrees");
  }
  return semview::validate(
      ViewProfile{{camera.columns, camera.rows, camera.elevation_min_rad, camera.elevation_max_rad},
                  camera.height_m});
}

Result<SimulationReport> simulate(const map::SemanticMap& world,
                                  const SimulationConfig& config,
                                  const std::filesystem::path& directory) {
  SEMVIEW_TRY_STATUS(validate(config));
  SimulationReport report;
  SEMVIEW_TRY(const Stage stage, set_stage(world, config, report));
  const Moments& moments = stage.moments;
  SEMVIEW_TRY(io::RunLogWriter log,
              io::RunLogWriter::create(directory, setup_of(world, config.camera)));
  SEMVIEW_TRY(report.wrong_label_share, record_frames(world, stage, config, log));
  Rng odometry_rng(config.seed, "odometry");
  const std::vector<io::StampedPose2> odometry =
      simulate_odometry(moments.odometry, config.odometry, config.noise_level, odometry_rng);
  SEMVIEW_TRY_STATUS(log.finish(odometry, moments.groundtruth));

  report.engine = stage.choice.engine->name();
  report.engine_reason = stage.choice.reason;
  report.frames = static_cast<int>(moments.frames.size());
  report.way_m = moments.way_m;
  report.duration_s = moments.groundtruth.back().stamp_s;
  report.start = moments.frames.front().pose;
  report.odometry_error_m = distance_m(moments.odometry.front().pose * odometry.back().pose,
                                       moments.odometry.back().pose);
  return report;
}

}  // namespace semview::simulation
