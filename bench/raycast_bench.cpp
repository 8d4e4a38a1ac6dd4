// SPDX-License-Identifier: Apache-2.0
// The packet path against a plain rtcIntersect1 loop on a furnished 40 m × 25 m floor.
//
// After Google Benchmark's own table the program casts both in turn, in one process and thread, and
// prints the ratio of the least times: on a busy machine only that is worth reading.
#include <algorithm>
#include <array>
#include <ctime>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "semview/benchmark/office_plan.hpp"
#include "semview/benchmark/plain_rays.hpp"
#include "semview/benchmark/subject.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/raycast/pinhole_renderer.hpp"

namespace semview::raycast {
namespace {

const benchmark::Subject& office() {
  static const auto subject = *benchmark::prepare_subject("office", benchmark::OfficePlan{});
  return *subject;
}

const Scene& floor_scene(bool robust) {
  static const Scene plain = *Scene::build(office().mesh, {false});
  return robust ? *office().scene : plain;
}

PanoramaRequest view_request(int columns, int pose) {
  static const std::vector<CellIndex> cells = office().sample(40);
  return office().request(cells[static_cast<std::size_t>(pose) % cells.size()],
                          benchmark::camera_of(columns));
}

ColumnView render_runs(const Scene& scene, const PanoramaRequest& request) {
  return render_column_view(scene, request);
}

template <auto kRender>
void cast(::benchmark::State& state) {
  const auto columns = static_cast<int>(state.range(0));
  const Scene& scene = floor_scene(state.range(1) != 0);
  int pose = 0;
  for (auto _ : state) {
    ::benchmark::DoNotOptimize(kRender(scene, view_request(columns, pose++)));
  }
  const double rays = static_cast<double>(state.iterations()) * columns * (columns / 4);
  state.counters["ray/s"] = ::benchmark::Counter(rays, ::benchmark::Counter::kIsRate);
}

/// Time that this thread has had the processor: on a busy machine a wall clock favours what is
/// short enough to end before another process comes in.
double thread_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <typename Render>
double seconds_of(const Render& render) {
  const double start_s = thread_s();
  ::benchmark::DoNotOptimize(render());
  return thread_s() - start_s;
}

/// Least times of one view each way, one after the other, added up over poses.
void print_ratio(int columns) {
  constexpr int kPoses = 8, kRepetitions = 12;
  static const benchmark::PlainRays loop(office().mesh);
  double robust_s = 0.0, plain_s = 0.0, runs_s = 0.0, singles_s = 0.0, loop_s = 0.0;
  for (int pose = 0; pose < kPoses; ++pose) {
    const PanoramaRequest request = view_request(columns, pose * 5);
    const auto directions = benchmark::directions_of(request);
    std::array<double, 5> least_s;
    least_s.fill(1e9);
    for (int i = 0; i < kRepetitions; ++i) {
      const std::array<double, 5> now_s{
          seconds_of([&] { return render_panorama(floor_scene(true), request); }),
          seconds_of([&] { return render_panorama(floor_scene(false), request); }),
          seconds_of([&] { return render_column_view(floor_scene(true), request); }),
          seconds_of([&] { return render_panorama_single_rays(floor_scene(true), request); }),
          seconds_of([&] { return loop.cast(request, directions); })};
      for (std::size_t k = 0; k < now_s.size(); ++k) least_s[k] = std::min(least_s[k], now_s[k]);
    }
    robust_s += least_s[0];
    plain_s += least_s[1];
    runs_s += least_s[2];
    singles_s += least_s[3];
    loop_s += least_s[4];
  }
  fmt::print("{}x{}: rtcIntersect1 loop {:.2f} ms", columns, columns / 4, 1e3 * loop_s / kPoses);
  const auto print = [&](const char* name, double seconds) {
    fmt::print("; {} {:.2f} ms, {:.2f}x", name, 1e3 * seconds / kPoses, loop_s / seconds);
  };
  print("packets robust", robust_s);
  print("plain", plain_s);
  print("runs robust", runs_s);
  print("single robust", singles_s);
  fmt::print("\n");
}

/// Rays a second of panoramas and pinhole views, both of some 300 000 rays, from one eye.
void print_rates(const char* name, const Scene& scene, const Pose2& pose, double eye_z_m) {
  constexpr int kRepetitions = 12;
  const PanoramaRequest panorama{pose, eye_z_m, {1080, 270}, {}};
  const PinholeRequest pinhole{level_camera(pose, eye_z_m), {}};
  double panorama_s = 1e9, pinhole_s = 1e9;
  for (int i = 0; i < kRepetitions; ++i) {
    panorama_s = std::min(panorama_s, seconds_of([&] { return render_panorama(scene, panorama); }));
    pinhole_s = std::min(pinhole_s, seconds_of([&] { return render_pinhole(scene, pinhole); }));
  }
  fmt::print("{}, {} triangles: panorama 1080x270 {:.1f} Mray/s, pinhole 640x480 {:.1f} Mray/s\n",
             name,
             scene.triangles(),
             1e-6 * 1080 * 270 / panorama_s,
             1e-6 * 640 * 480 / pinhole_s);
}

/// The shipped mesh of a furnished house, from its middle.
void print_mesh_rates() {
  const auto map = map::load_map(SEMVIEW_SOURCE_DIR "/maps/duplex_building");
  const Scene scene = *Scene::build(*map);
  const Eigen::Vector3f middle = 0.5F * (scene.bounds().min + scene.bounds().max);
  print_rates("duplex_building", scene, {middle.x(), middle.y(), 0.4}, map->ground_height_m + 1.2);
}

BENCHMARK_TEMPLATE(cast, render_panorama)->ArgsProduct({{360, 720}, {0, 1}})->Name("packets");
BENCHMARK_TEMPLATE(cast, render_runs)->ArgsProduct({{360, 720}, {0, 1}})->Name("runs");
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
  for (const int columns : {360, 720}) semview::raycast::print_ratio(columns);
  const semview::raycast::PanoramaRequest view = semview::raycast::view_request(360, 0);
  semview::raycast::print_rates(
      "office", semview::raycast::floor_scene(true), view.map_from_robot, view.eye_z_m);
  semview::raycast::print_mesh_rates();
  return 0;
}
