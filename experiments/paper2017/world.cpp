// SPDX-License-Identifier: Apache-2.0
#include "world.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene_builder.hpp"
#include "semview/core/random.hpp"

namespace semview::paper2017 {
namespace {

constexpr double kRobotRadius_m = 0.28;
constexpr int kTries = 400;
constexpr int kPlacesToChooseFrom = 4;
constexpr std::int32_t kPersonObject = 1 << 20;

/// A free place in a part of a room, given by shares of its length and depth.
Pose2 free_place(const Scene& scene, const Room& room, double from_x, double to_x, Rng& rng) {
  const double length_m = room.max_x_m - room.min_x_m;
  Pose2 place;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    place = {rng.uniform(room.min_x_m + from_x * length_m, room.min_x_m + to_x * length_m),
             rng.uniform(room.min_y_m + 0.45, room.max_y_m - 0.45),
             0.0};
    if (!scene.blocked(place.x_m, place.y_m, kRobotRadius_m, 0.05, 1.35)) break;
  }
  return place;
}

/// Where the robot stops and looks along its way.
std::vector<Pose2> plan_way(const Layout& layout, const Scene& scene, Rng& rng) {
  const Room& lab_a = layout.rooms[kLabA];
  const Room& lab_b = layout.rooms[kLabB];
  const Room& corridor = layout.rooms[kCorridor];
  const Room& room = layout.rooms[layout.visited_room];
  const double length_m = corridor.max_x_m - corridor.min_x_m;
  const auto at = [&](const Room& other, double share) {
    const double x_m = other.min_x_m + share * (other.max_x_m - other.min_x_m);
    return (x_m - corridor.min_x_m) / length_m;
  };
  std::vector<Pose2> way;
  // Of a few places the one nearest to where the robot is: it does not criss-cross rooms.
  const auto stop = [&](const Room& in, double from_x, double to_x) {
    Pose2 nearest = free_place(scene, in, from_x, to_x, rng);
    for (int i = 1; i < kPlacesToChooseFrom && !way.empty(); ++i) {
      const Pose2 other = free_place(scene, in, from_x, to_x, rng);
      if (distance_m(other, way.back()) < distance_m(nearest, way.back())) nearest = other;
    }
    way.push_back(nearest);
  };
  stop(lab_a, 0.08, 0.35);
  stop(lab_a, 0.35, 0.65);
  stop(lab_a, 0.65, 0.92);
  stop(corridor, at(lab_a, 0.5), at(lab_a, 0.9));
  stop(corridor, at(room, 0.3), at(room, 0.7));
  stop(room, 0.2, 0.8);
  stop(corridor, at(room, 0.5), at(room, 0.9));
  stop(corridor, at(lab_b, 0.4), at(lab_b, 0.7));
  stop(lab_b, 0.10, 0.35);
  stop(lab_b, 0.35, 0.60);
  stop(lab_b, 0.60, 0.92);
  stop(lab_b, 0.30, 0.70);
  stop(corridor, at(lab_b, 0.2), at(lab_b, 0.5));
  stop(corridor, at(lab_a, 0.8), at(lab_a, 1.0));
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Pose2& from = way[i + 1 < way.size() ? i : i - 1];
    const Pose2& to = way[i + 1 < way.size() ? i + 1 : i];
    way[i].yaw_rad =
        wrap_angle(std::atan2(to.y_m - from.y_m, to.x_m - from.x_m) + rng.normal(0.0, 0.35));
  }
  return way;
}

std::vector<Pose2> odometry_of(const std::vector<Pose2>& way,
                               const OdometryConfig& config,
                               std::uint64_t seed) {
  Rng rng(seed, "odometry");
  const double scale = 1.0 + rng.normal(0.0, config.scale_sigma);
  std::vector<Pose2> odometry{{}};
  for (std::size_t i = 1; i < way.size(); ++i) {
    Pose2 step = inverse(way[i - 1]) * way[i];
    step.x_m *= scale;
    step.y_m *= scale;
    step.yaw_rad = wrap_angle(step.yaw_rad + rng.normal(0.0, config.drift_sigma_rad));
    odometry.push_back(odometry.back() * step);
  }
  return odometry;
}

/// Someone 1.2 to 3 m away, if there is room for one.
std::vector<Primitive> somebody(const Scene& scene, const Pose2& robot, Rng& rng) {
  for (int attempt = 0; attempt < 30; ++attempt) {
    const double azimuth_rad = rng.uniform(-kPi, kPi);
    const double distance_m = rng.uniform(1.2, 3.0);
    const double x_m = robot.x_m + distance_m * std::cos(azimuth_rad);
    const double y_m = robot.y_m + distance_m * std::sin(azimuth_rad);
    if (scene.blocked(x_m, y_m, 0.3, 0.05, 1.8)) continue;
    return person(x_m, y_m, rng.uniform(1.6, 1.9), kPersonObject);
  }
  return {};
}

SceneView look(const Scene& scene, const Pose2& robot, const CameraConfig& config, Rng& rng) {
  SceneCamera camera;
  camera.position_m = {
      robot.x_m, robot.y_m, config.height_m + rng.normal(0.0, config.height_sigma_m)};
  camera.yaw_rad = robot.yaw_rad;
  camera.pitch_rad = rng.normal(0.0, config.tilt_sigma_rad);
  camera.roll_rad = rng.normal(0.0, config.tilt_sigma_rad);
  camera.width_rad = config.width_rad;
  camera.height_rad = config.height_rad;
  camera.columns = static_cast<int>(std::lround(config.width_rad / config.pixel_rad));
  camera.rows = static_cast<int>(std::lround(config.height_rad / config.pixel_rad));
  if (rng.uniform() >= config.person_share) return scene.render(camera);
  std::vector<Primitive> solids = scene.primitives();
  for (const Primitive& part : somebody(scene, robot, rng)) solids.push_back(part);
  return Scene(std::move(solids)).render(camera);
}

}  // namespace

std::string describe(const WorldConfig& config) {
  const LayoutConfig& layout = config.layout;
  const CameraConfig& camera = config.camera;
  const LabelNoiseConfig& noise = config.noise;
  return fmt::format(
      "floor: {:g} x {:g} m; missing in map {:g}, in world {:g}; chairs off {:g} m, {:g} rad; "
      "doors in another state {:g}; clutter {} + {}\n"
      "camera: {:g} x {:g} deg, pixel {:g} deg; height {:g} m, off {:g} m; tilt {:g} deg; people "
      "in {:g}\n"
      "odometry: scale {:g}, drift {:g} rad a step\n"
      "labels: level {:g} of objects {:g}, patches {:g} of {:g} rad, borders {:g} rad over {:g} "
      "rad, salt {:g}\n",
      layout.width_m,
      layout.depth_m,
      layout.missing_in_map,
      layout.missing_in_world,
      layout.chair_shift_m,
      layout.chair_turn_rad,
      layout.other_door_state,
      layout.floor_clutter,
      layout.wall_clutter,
      deg_from_rad(camera.width_rad),
      deg_from_rad(camera.height_rad),
      deg_from_rad(camera.pixel_rad),
      camera.height_m,
      camera.height_sigma_m,
      deg_from_rad(camera.tilt_sigma_rad),
      camera.person_share,
      config.odometry.scale_sigma,
      config.odometry.drift_sigma_rad,
      noise.level,
      noise.object_error,
      noise.patch_share,
      noise.patch_rad,
      noise.border_shift_rad,
      noise.border_wave_rad,
      noise.salt_share);
}

World make_world(const WorldConfig& config, const WorldSeeds& seeds) {
  World world;
  world.layout = draw_layout(config.layout, seeds.layout);
  const Scene scene = build_scene(world.layout);
  Rng way_rng(seeds.layout, "way");
  const std::vector<Pose2> way = plan_way(world.layout, scene, way_rng);
  const std::vector<Pose2> odometry = odometry_of(way, config.odometry, seeds.odometry);
  for (std::size_t i = 0; i < way.size(); ++i) {
    Stop stop;
    stop.map_from_robot = way[i];
    stop.odom_from_robot = odometry[i];
    Rng camera_rng(seeds.camera, "camera", i);
    stop.truth = look(scene, way[i], config.camera, camera_rng);
    Rng view_seed(seeds.segmentation, "view", i);
    stop.labels = misread(stop.truth,
                          config.camera.pixel_rad,
                          config.noise,
                          seeds.segmentation,
                          view_seed.next_u64());
    world.stops.push_back(std::move(stop));
  }
  world.camera.columns = world.stops.front().labels.columns();
  world.camera.rows = world.stops.front().labels.rows();
  world.camera.azimuth_left_rad = config.camera.width_rad / 2.0;
  world.camera.azimuth_right_rad = -config.camera.width_rad / 2.0;
  world.camera.elevation_min_rad = -config.camera.height_rad / 2.0;
  world.camera.elevation_max_rad = config.camera.height_rad / 2.0;
  world.camera.position_m = {0.0, 0.0, config.camera.height_m};
  return world;
}

}  // namespace semview::paper2017
