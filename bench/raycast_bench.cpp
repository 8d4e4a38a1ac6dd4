// SPDX-License-Identifier: Apache-2.0
// The packet path against a plain rtcIntersect1 loop on a furnished 40 m × 25 m floor.
//
// After Google Benchmark's own table the program casts both in turn, in one process and thread, and
// prints the ratio of the least times: on a busy machine only that is worth reading.
#include <algorithm>
#include <chrono>
#include <cstdint>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "semview/core/random.hpp"
#include "semview/map/column_map.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/raycast/panorama_renderer.hpp"

namespace semview::raycast {
namespace {

constexpr ClassId kFloor = 1, kCeiling = 2, kWall = 3, kDoor = 4, kWindow = 5, kTable = 6;
constexpr std::uint8_t kFreePixel = 1, kWallPixel = 2, kDoorPixel = 3, kWindowPixel = 4,
                       kTablePixel = 5;

void place_tables(Image<std::uint8_t>& pixels) {
  Rng rng(1, "tables");
  for (int i = 0; i < 120; ++i) {
    const auto top = static_cast<int>(rng.below(440));
    const auto left = static_cast<int>(rng.below(740));
    for (int r = top; r < top + 16; ++r) {
      for (int c = left; c < left + 28; ++c) {
        std::uint8_t& pixel = pixels.at(r, c);
        if (pixel == kFreePixel) pixel = kTablePixel;
      }
    }
  }
}

/// Rooms of 5 m × 5 m with open doors under lintels, windows in the outer walls, and tables, at 5
/// cm.
map::ColumnMap office() {
  map::ColumnMap plan;
  plan.resolution_m = 0.05;
  plan.ceiling = map::Ceiling{kCeiling, 2.7};
  plan.profiles = {
      {true, false, kNoHit, {}},
      {false, false, kFloor, {}},
      {false, false, kFloor, {{0.0, 2.7, kWall}}},
      {false, true, kFloor, {{2.1, 2.7, kWall}}},
      {false, false, kFloor, {{0.0, 0.9, kWall}, {0.9, 2.1, kWindow}, {2.1, 2.7, kWall}}},
      {false, false, kFloor, {{0.7, 0.75, kTable}}},
  };
  constexpr int kRows = 500, kColumns = 800, kRoom = 100;
  plan.profile_of_pixel = Image<std::uint8_t>(kRows, kColumns, kFreePixel);
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kColumns; ++c) {
      const bool across = r % kRoom < 3 || r >= kRows - 3;
      const bool along = c % kRoom < 3 || c >= kColumns - 3;
      if (!across && !along) continue;
      const bool outer = r < 3 || c < 3 || r >= kRows - 3 || c >= kColumns - 3;
      const int place = across ? c % kRoom : r % kRoom;
      const bool opening = place > 40 && place < 58;
      plan.profile_of_pixel.at(r, c) = !opening ? kWallPixel : outer ? kWindowPixel : kDoorPixel;
    }
  }
  place_tables(plan.profile_of_pixel);
  return plan;
}

const Scene& floor_scene(bool robust) {
  static const map::TriangleMesh mesh = map::extrude(office());
  static const Scene watertight = *Scene::build(mesh, {true});
  static const Scene plain = *Scene::build(mesh, {false});
  return robust ? watertight : plain;
}

/// One of 40 poses, one a room.
PanoramaRequest view_request(int columns, int pose) {
  PanoramaRequest request;
  request.map_from_robot = {2.33 + 5.0 * (pose % 8), 1.21 + 5.0 * (pose / 8 % 5), 0.0};
  request.camera.columns = columns;
  request.camera.rows = columns / 4;
  return request;
}

template <auto kRender>
void cast(benchmark::State& state) {
  const auto columns = static_cast<int>(state.range(0));
  const Scene& scene = floor_scene(state.range(1) != 0);
  int pose = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(kRender(scene, view_request(columns, pose++)));
  }
  const double rays = static_cast<double>(state.iterations()) * columns * (columns / 4);
  state.counters["ray/s"] = benchmark::Counter(rays, benchmark::Counter::kIsRate);
}

template <auto kRender>
double seconds_of(const Scene& scene, const PanoramaRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  benchmark::DoNotOptimize(kRender(scene, request));
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void print_ratio(int columns, bool robust) {
  constexpr int kPoses = 8, kRepetitions = 12;
  const Scene& scene = floor_scene(robust);
  double packets_s = 0.0;
  double singles_s = 0.0;
  for (int pose = 0; pose < kPoses; ++pose) {
    const PanoramaRequest request = view_request(columns, pose * 5);
    double packet_s = 1e9;
    double single_s = 1e9;
    for (int i = 0; i < kRepetitions; ++i) {
      packet_s = std::min(packet_s, seconds_of<render_panorama>(scene, request));
      single_s = std::min(single_s, seconds_of<render_panorama_single_rays>(scene, request));
    }
    packets_s += packet_s;
    singles_s += single_s;
  }
  const double rays = 1.0 * kPoses * columns * (columns / 4);
  fmt::print(
      "{}x{} {:6}: packets {:.2f} ms a view, {:.1f} Mray/s; single rays {:.2f} ms; {:.2f}x\n",
      columns,
      columns / 4,
      robust ? "robust" : "plain",
      1e3 * packets_s / kPoses,
      1e-6 * rays / packets_s,
      1e3 * singles_s / kPoses,
      singles_s / packets_s);
}

BENCHMARK_TEMPLATE(cast, render_panorama)->ArgsProduct({{360, 720}, {0, 1}})->Name("packets");
BENCHMARK_TEMPLATE(cast, render_column_view)->ArgsProduct({{360, 720}, {0, 1}})->Name("runs");
BENCHMARK_TEMPLATE(cast, render_panorama_single_rays)
    ->ArgsProduct({{360, 720}, {0, 1}})
    ->Name("single_rays");

}  // namespace
}  // namespace semview::raycast

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  fmt::print("{} triangles\n", semview::raycast::floor_scene(true).triangles());
  for (const int columns : {360, 720}) {
    for (const bool robust : {false, true}) semview::raycast::print_ratio(columns, robust);
  }
  return 0;
}
