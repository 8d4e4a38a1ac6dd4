// SPDX-License-Identifier: Apache-2.0
// The columns caster beside Embree's packets, in one process and thread, taken in turn; of each the
// least time. Then its walk on every target that the machine can run, and ray by ray.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <hwy/targets.h>

#include "semview/benchmark/office_plan.hpp"
#include "semview/core/random.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/map/map_reader.hpp"
#include "semview/raycast/column_camera.hpp"
#include "semview/raycast/column_painter.hpp"
#include "semview/raycast/column_renderer.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "usage.hpp"

namespace semview::raycast {
namespace {

constexpr int kEyes = 8;
constexpr int kRounds = 10;

/// Eyes that see, spread over a plan.
std::vector<PanoramaRequest> requests_over(const map::ColumnMap& plan, int columns) {
  std::vector<PanoramaRequest> requests;
  const map::Bounds bounds = plan.bounds();
  Rng rng(1, "eyes");
  while (requests.size() < kEyes) {
    PanoramaRequest request;
    request.camera.columns = columns;
    request.camera.rows = columns / 4;
    request.eye_z_m = plan.ground_height_m + 1.2;
    request.map_from_robot = {
        std::round(rng.uniform(bounds.min_x_m, bounds.max_x_m) * 10.0) / 10.0 + 0.05,
        std::round(rng.uniform(bounds.min_y_m, bounds.max_y_m) * 10.0) / 10.0 + 0.05,
        0.0};
    const ColumnProfile* profile = plan.at(request.map_from_robot.x_m, request.map_from_robot.y_m);
    if (profile == nullptr || profile->outside ||
        profile->reaches_into(request.eye_z_m - 0.05, request.eye_z_m + 0.05)) {
      continue;
    }
    requests.push_back(request);
  }
  return requests;
}

/// Least microseconds of each, one after the other, round after round. A short one is repeated
/// within its turn: as in a batch of views, its data are in the caches then.
std::vector<double> least_us(const std::vector<std::function<void()>>& contenders) {
  using Clock = std::chrono::steady_clock;
  constexpr double kTurn_us = 400.0;
  std::vector<double> least(contenders.size(), 1e9);
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      for (double turn_us = 0.0; turn_us < kTurn_us;) {
        const auto start = Clock::now();
        contenders[i]();
        const std::chrono::duration<double, std::micro> time = Clock::now() - start;
        least[i] = std::min(least[i], time.count());
        turn_us += time.count();
      }
    }
  }
  return least;
}

/// What takes part, for one eye.
std::vector<std::function<void()>> contenders_for(const Scene& plain,
                                                  const Scene& robust,
                                                  const ColumnScene& columns,
                                                  const PanoramaRequest& request) {
  const auto casts = [&request](auto&& cast) {
    return [&request, cast] { ::benchmark::DoNotOptimize(cast(request)); };
  };
  return {
      casts([&](const PanoramaRequest& view) { return render_panorama(plain, view); }),
      casts([&](const PanoramaRequest& view) { return render_panorama(robust, view); }),
      casts([&](const PanoramaRequest& view) { return render_column_view(plain, view); }),
      casts([&](const PanoramaRequest& view) { return render_column_view(columns, view, false); }),
      casts([&](const PanoramaRequest& view) { return render_column_view(columns, view, true); }),
      casts([&](const PanoramaRequest& view) { return render_panorama(columns, view); }),
  };
}

void compare(const std::string& name, const map::ColumnMap& plan, int columns) {
  const map::TriangleMesh mesh = map::extrude(plan);
  const Scene plain = *Scene::build(mesh, {false});
  const Scene robust = *Scene::build(mesh, {true});
  const ColumnScene scene = ColumnScene::build(plan);
  std::vector<double> sums;
  for (const PanoramaRequest& request : requests_over(plan, columns)) {
    const std::vector<double> least = least_us(contenders_for(plain, robust, scene, request));
    sums.resize(least.size());
    for (std::size_t i = 0; i < least.size(); ++i) sums[i] += least[i] / kEyes;
  }
  fmt::print(
      "{:20} {:3} x {:3} | Embree label + range plain {:5.0f} us, robust {:5.0f} us, label runs "
      "{:5.0f} us | columns label {:5.1f} us {:4.0f}x, label + range {:5.1f} us {:4.0f}x ({:.0f}x "
      "robust), pixels {:5.1f} us {:4.1f}x\n",
      name,
      columns,
      columns / 4,
      sums[0],
      sums[1],
      sums[2],
      sums[3],
      sums[2] / sums[3],
      sums[4],
      sums[0] / sums[4],
      sums[1] / sums[4],
      sums[5],
      sums[0] / sums[5]);
}

/// 0 stands for the best.
void walk_by(std::int64_t target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

/// The parts of a view, and the walk by each target.
void take_apart(const std::string& name, const map::ColumnMap& plan, int columns) {
  const ColumnScene scene = ColumnScene::build(plan);
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  std::vector<std::string> parts = {"aim", "paint labels", "paint with planes", "walk ray by ray"};
  for (const std::int64_t target : targets) {
    parts.push_back(fmt::format("walk {}", hwy::TargetName(target)));
  }
  std::vector<double> sums(parts.size());
  for (const PanoramaRequest& request : requests_over(plan, columns)) {
    const ColumnCamera camera(request.camera);
    ColumnRays rays;
    Crossings crossings;
    RunCollection runs;
    const auto paint = [&](bool ranges) {
      ColumnPainter(plan, request.eye_z_m, ranges).paint(crossings, camera.rows(), runs);
    };
    camera.aim(scene, request, rays);
    walk_columns(scene.grid(), rays, crossings);
    std::vector<double> least = least_us({
        [&] { camera.aim(scene, request, rays); },
        [&] { paint(false); },
        [&] { paint(true); },
        [&] { walk_columns_singly(scene.grid(), rays, crossings); },
    });
    for (const std::int64_t target : targets) {
      walk_by(target);
      least.push_back(least_us({[&] { walk_columns(scene.grid(), rays, crossings); }}).front());
    }
    walk_by(0);
    for (std::size_t i = 0; i < least.size(); ++i) sums[i] += least[i] / kEyes;
  }
  fmt::print("{:20} {:3} x {:3} |", name, columns, columns / 4);
  for (std::size_t i = 0; i < parts.size(); ++i) fmt::print(" {} {:.1f} us;", parts[i], sums[i]);
  fmt::print("\n");
}

int run() {
  std::vector<std::pair<std::string, map::SemanticMap>> maps;
  for (const double resolution_m : {0.05, 0.02}) {
    auto office = semview::benchmark::draw_office({.resolution_m = resolution_m});
    if (!office) return 1;
    maps.emplace_back(fmt::format("office {:g} cm", 100.0 * resolution_m), std::move(*office));
  }
  for (const char* name : {"duplex_level1", "duplex_level2", "largebuilding_level1", "tutorial"}) {
    auto map = map::load_map(std::string(SEMVIEW_SOURCE_DIR "/maps/") + name);
    if (!map) return 1;
    maps.emplace_back(name, std::move(*map));
  }
  for (const int columns : {360, 720}) {
    for (const auto& [name, map] : maps) compare(name, *map.columns(), columns);
    for (const auto& [name, map] : maps) take_apart(name, *map.columns(), columns);
  }
  return 0;
}

}  // namespace
}  // namespace semview::raycast

int main(int argc, char** argv) {
  constexpr const char* kUsage =
      "bench_columns\n"
      "The columns caster beside Embree's packets on the shipped plans; then its walk on every "
      "target\n"
      "that this machine can run, and ray by ray.";
  if (const auto code = semview::bench::explain(argc, argv, kUsage)) return *code;
  return semview::raycast::run();
}
