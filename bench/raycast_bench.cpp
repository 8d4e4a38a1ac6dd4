// SPDX-License-Identifier: Apache-2.0
// The packet path against a plain rtcIntersect1 loop on a furnished 40 m × 25 m floor.
//
// After Google Benchmark's own table the program casts both in turn, in one process and thread, and
// prints the ratio of the least times: on a busy machine only that is worth reading.
#include <algorithm>
#include <chrono>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "semview/benchmark/office_plan.hpp"
#include "semview/benchmark/subject.hpp"
#include "semview/raycast/panorama_renderer.hpp"

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

template <auto kRender>
double seconds_of(const Scene& scene, const PanoramaRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  ::benchmark::DoNotOptimize(kRender(scene, request));
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
  for (const int columns : {360, 720}) {
    for (const bool robust : {false, true}) semview::raycast::print_ratio(columns, robust);
  }
  return 0;
}
