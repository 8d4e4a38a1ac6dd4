// SPDX-License-Identifier: Apache-2.0
// What it costs to score a view: `bench_score MAP` (default: maps/duplex_level1).
//
// The scorer on runs, the naive loop over pixels with real weights, the same loop in integers, and
// the mere reading of as many bytes as the scorer reads from its table take turns in one process
// and thread. The loops over pixels get the views as pixels for free. The least time of each is
// printed: on a busy machine only the ratios are worth reading. Ends with exit code 1 if the
// scorer's sums are not those of the integer loop.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <hwy/aligned_allocator.h>

#include "semview/benchmark/pixel_scorer.hpp"
#include "semview/benchmark/read_bytes.hpp"
#include "semview/core/random.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/observation/dense_posterior.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/service/site.hpp"
#include "semview/similarity/heat_map.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "semview/similarity/similarity_score_source.hpp"
#include "usage.hpp"

namespace semview {
namespace {

/// Views that the scorer takes; their runs do not fit the nearest cache.
constexpr std::size_t kCells = 256;
/// Of those, the ones that the loops over pixels take: they are slow.
constexpr std::size_t kSlowCells = 8;
constexpr int kRounds = 20;
constexpr std::size_t kListed = 8;
constexpr std::size_t kFloorCells = 8192;

using Sums = std::array<std::int32_t, PoseGrid::kHeadings>;

void must(const Status& status) {
  if (status) return;
  fmt::print(stderr, "bench_score: {}\n", status.error().message);
  std::exit(1);
}

template <typename T>
T must(Result<T> result) {
  if (!result) {
    fmt::print(stderr, "bench_score: {}\n", result.error().message);
    std::exit(1);
  }
  return *std::move(result);
}

double thread_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The least time of some work over all rounds, of the thread's own.
struct Part {
  double least_s = std::numeric_limits<double>::infinity();

  template <typename Work>
  void run(const Work& work) {
    const double start_s = thread_s();
    work();
    least_s = std::min(least_s, thread_s() - start_s);
  }
  double us_a_view(std::size_t views) const { return 1e6 * least_s / static_cast<double>(views); }
};

/// Seen from between the cells, a little higher than the map's views.
Observation observe(const service::Site& site, const CellIndex& cell) {
  raycast::PanoramaRequest request;
  const Pose2 center = PoseGrid::center(cell);
  request.map_from_robot = {center.x_m + 0.03, center.y_m - 0.02, 0.7};
  request.eye_z_m = site.eye_z_m(1.22);
  request.camera = site.profile().camera;
  return {site.map().classes, must(site.exact_panorama(request)).labels, 0.0};
}

/// What a full compass reads of the table: a row of 120 sums for each end of a run but the top.
std::size_t table_bytes_of(const ViewBatch& views) {
  std::size_t rows = 0;
  for (const SharedView& view : views.views) {
    rows += 2 * view->runs().size() - static_cast<std::size_t>(view->columns());
  }
  return rows * PoseGrid::kHeadings * sizeof(std::int16_t);
}

/// Blind but for `degrees` in the middle.
Observation narrowed(Observation observation, int degrees) {
  const int columns = observation.labels.columns();
  const int seen = columns * degrees / 360;
  for (int r = 0; r < observation.labels.rows(); ++r) {
    for (int c = 0; c < columns; ++c) {
      if (2 * std::abs(c - columns / 2) > seen) observation.labels.at(r, c) = kUnknown;
    }
  }
  return observation;
}

/// The scorer's own times with one observation.
struct Scorer {
  similarity::PreparedObservation prepared;
  std::vector<Sums> sums = std::vector<Sums>(kCells);
  Part all = {};
  Part one = {};
  Part list = {};

  void round(const ViewBatch& views) {
    all.run([&] {
      for (std::size_t i = 0; i < kCells; ++i) prepared.all_headings(*views.views[i], sums[i]);
    });
    one.run([&] {
      for (std::size_t i = 0; i < kCells; ++i) {
        sums[i][i % 120] = prepared.sum(*views.views[i], static_cast<int>(i % 120));
      }
    });
    constexpr std::array<std::uint8_t, kListed> kHeadings{3, 4, 5, 7, 8, 9, 11, 90};
    std::array<std::int32_t, kListed> listed{};
    list.run([&] {
      for (std::size_t i = 0; i < kCells; ++i) {
        prepared.some_headings(*views.views[i], kHeadings, listed);
      }
    });
  }
};

/// The alternatives' times, on the first views only.
struct Loops {
  std::vector<LabelImage> pixels = {};
  benchmark::PixelWeights<float> real;
  benchmark::PixelWeights<std::int32_t> whole;
  std::vector<Sums> sums = std::vector<Sums>(kSlowCells);
  std::vector<std::array<float, PoseGrid::kHeadings>> real_sums =
      std::vector<std::array<float, PoseGrid::kHeadings>>(kSlowCells);
  Part floats = {};
  Part integers = {};

  void round(const LabelImage& observed) {
    floats.run([&] {
      for (std::size_t i = 0; i < kSlowCells; ++i) {
        real_sums[i] = benchmark::score_pixels<float, float>(observed, pixels[i], real);
      }
    });
    integers.run([&] {
      for (std::size_t i = 0; i < kSlowCells; ++i) {
        sums[i] = benchmark::score_pixels<std::int32_t, std::int32_t>(observed, pixels[i], whole);
      }
    });
  }
};

void print(const Scorer& whole, const Scorer& narrow, const Loops& loops, double read_us) {
  const double all_us = whole.all.us_a_view(kCells);
  const double floats_us = loops.floats.us_a_view(kSlowCells);
  const double integers_us = loops.integers.us_a_view(kSlowCells);
  fmt::print("  all headings, runs            {:9.2f} us a view\n", all_us);
  fmt::print(
      "  all headings, float pixels    {:9.2f} us, {:.0f}x\n", floats_us, floats_us / all_us);
  fmt::print(
      "  all headings, integer pixels  {:9.2f} us, {:.0f}x\n", integers_us, integers_us / all_us);
  fmt::print("  the table's bytes, read only  {:9.2f} us; the runs take {:.2f}x of it\n",
             read_us,
             all_us / read_us);
  const double one_us = whole.one.us_a_view(kCells);
  fmt::print("  one heading, runs             {:9.2f} us; float pixels {:.1f}x\n",
             one_us,
             floats_us / PoseGrid::kHeadings / one_us);
  fmt::print(
      "  {} headings, runs              {:9.2f} us\n", kListed, whole.list.us_a_view(kCells));
  fmt::print("  60 degrees seen: all headings {:9.2f} us, one {:.2f} us, {} {:.2f} us\n",
             narrow.all.us_a_view(kCells),
             narrow.one.us_a_view(kCells),
             kListed,
             narrow.list.us_a_view(kCells));
}

/// Whole floors: the heat map and the posterior of cells whose views are in memory.
struct Floor {
  std::vector<CellIndex> cells;
  Part heat = {};
  Part posterior = {};

  void round(const service::Site& site,
             const similarity::PreparedObservation& prepared,
             ScoreSource& source) {
    heat.run([&] {
      must(similarity::heat_map(prepared, site.views(), cells, PoseGrid::kHeadings, site.pool()));
    });
    posterior.run([&] { must(observation::DensePosterior::compute(source, {}, cells, {})); });
  }
  /// Of 100 000 cells, 12 million poses.
  static double scaled_s(const Part& part, std::size_t cells) {
    return part.least_s * 1e5 / static_cast<double>(cells);
  }
  void print() const {
    fmt::print(
        "  100 000 cells, 120 headings   {:9.2f} s as a heat map, {:.2f} s as a posterior (from {} "
        "cells)\n",
        scaled_s(heat, cells.size()),
        scaled_s(posterior, cells.size()),
        cells.size());
  }
};

/// A map, its weights, and what is seen in it.
struct Scene {
  std::shared_ptr<service::Site> site;
  similarity::WeightMatrix weights;
  std::vector<CellIndex> free;
  ViewBatch views;  ///< of `kCells` cells
  Observation observation;

  static Scene open(const std::string& folder) {
    service::SiteConfig config;
    config.threads = 1;
    auto site = must(service::Site::open(folder, config));
    auto weights = must(similarity::read_weight_matrix(folder + "/weights.csv"));
    std::vector<CellIndex> free = site->cells().free_cells();
    Rng rng(1, "bench_score");
    std::vector<CellIndex> cells;
    for (std::size_t i = 0; i < kCells; ++i) cells.push_back(free[rng.below(free.size())]);
    ViewBatch views = must(site->views().views(cells));
    Observation observation = observe(*site, cells[0]);
    return {std::move(site),
            std::move(weights),
            std::move(free),
            std::move(views),
            std::move(observation)};
  }
  const ClassTable& classes() const { return site->map().classes; }
  similarity::PreparedObservation prepare(const Observation& seen) const {
    return must(
        similarity::PreparedObservation::build(seen, weights, classes(), site->profile().camera));
  }
};

/// The alternatives of a scene, for sums as whole as the scorer's.
Loops loops_of(const Scene& scene, double weight_scale) {
  Loops loops{.real = {scene.weights, scene.classes(), scene.classes(), 1.0},
              .whole = {scene.weights, scene.classes(), scene.classes(), weight_scale}};
  for (std::size_t i = 0; i < kSlowCells; ++i) {
    loops.pixels.push_back(scene.views.views[i]->to_labels(0));
  }
  return loops;
}

int run(const std::string& folder) {
  const Scene scene = Scene::open(folder);
  Scorer whole{scene.prepare(scene.observation)};
  Scorer narrow{scene.prepare(narrowed(scene.observation, 60))};
  Loops loops = loops_of(scene, static_cast<double>(whole.prepared.weight_scale()));
  const auto floor_cells = static_cast<std::ptrdiff_t>(std::min(kFloorCells, scene.free.size()));
  Floor floor{{scene.free.begin(), scene.free.begin() + floor_cells}};
  similarity::SimilarityScoreSource source(
      scene.site->views(), scene.classes(), scene.weights, scene.site->pool());
  must(source.set_observation(scene.observation));
  must(scene.site->views().views(floor.cells));

  Part build;
  Part read;
  const std::size_t bytes = table_bytes_of(scene.views);
  const std::size_t words = whole.prepared.byte_size() / 2048 * 256;
  const auto memory = hwy::AllocateAligned<std::uint64_t>(words);
  std::fill_n(memory.get(), words, 1U);
  std::uint64_t sum = 0;
  for (int round = 0; round < kRounds; ++round) {
    whole.round(scene.views);
    loops.round(scene.observation.labels);
    narrow.round(scene.views);
    if (round % 5 == 0) floor.round(*scene.site, whole.prepared, source);
    read.run([&] { sum += benchmark::read_bytes({memory.get(), words}, bytes); });
    build.run([&] {
      sum += static_cast<std::uint64_t>(scene.prepare(scene.observation).weight_scale());
    });
  }
  const bool equal = std::ranges::equal(loops.sums, std::span(whole.sums).first(kSlowCells));
  const PanoramaCamera& camera = scene.site->profile().camera;
  fmt::print("{}: views of {}x{}, {} classes, one thread\n",
             folder,
             camera.columns,
             camera.rows,
             scene.classes().size());
  print(whole, narrow, loops, read.us_a_view(kCells));
  floor.print();
  fmt::print("  table of the observation      {:9.2f} us, {} kB\n",
             1e6 * build.least_s,
             whole.prepared.byte_size() / 1000);
  fmt::print(
      "  {} with the integer pixels ({})\n", equal ? "equal sums" : "DIFFERENT SUMS", sum % 2);
  return equal ? 0 : 1;
}

}  // namespace
}  // namespace semview

int main(int argc, char** argv) {
  constexpr const char* kUsage =
      "bench_score [MAP]\n"
      "What it costs to score a view of a map that has a weights.csv (default: duplex_level1), "
      "beside\n"
      "loops over its pixels and the mere reading of as many bytes; exit code 1 if sums differ.";
  if (const auto code = semview::bench::explain(argc, argv, kUsage)) return *code;
  return semview::run(argc > 1 ? argv[1] : SEMVIEW_SOURCE_DIR "/maps/duplex_level1");
}
