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
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <hwy/aligned_allocator.h>

#include "semview/benchmark/read_bytes.hpp"
#include "semview/core/random.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/service/site.hpp"
#include "semview/similarity/prepared_observation.hpp"

namespace semview {
namespace {

/// Views that the scorer takes; their runs do not fit the nearest cache.
constexpr std::size_t kCells = 256;
/// Of those, the ones that the loops over pixels take: they are slow.
constexpr std::size_t kSlowCells = 8;
constexpr int kRounds = 20;
constexpr std::size_t kListed = 8;

using Sums = std::array<std::int32_t, PoseGrid::kHeadings>;

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

/// w[observed][map], the rows that are not scored all 0: the loops need no branch for them.
template <typename Weight>
struct PixelWeights {
  std::vector<Weight> values = std::vector<Weight>(std::size_t{256} * 256, Weight{0});

  PixelWeights(const similarity::WeightMatrix& weights, const ClassTable& classes, double scale) {
    const auto index = [](const auto& names, std::string_view name) {
      return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    };
    for (std::size_t o = 1; o <= static_cast<std::size_t>(classes.size()); ++o) {
      const std::size_t row =
          index(weights.observed_names(), classes.name(static_cast<ClassId>(o)));
      for (std::size_t m = 0; m <= static_cast<std::size_t>(classes.size()); ++m) {
        const std::size_t column =
            index(weights.map_names(),
                  m == 0 ? similarity::kNoneColumn : classes.name(static_cast<ClassId>(m)));
        const double weight = weights.weight(0, row, column) * scale;
        values[o * 256 + m] =
            static_cast<Weight>(std::is_integral_v<Weight> ? std::round(weight) : weight);
      }
    }
  }
};

/// Equation (1)'s numerator at every heading, pixel by pixel.
template <typename Weight, typename Sum>
void score_pixels(const LabelImage& observed,
                  const LabelImage& view,
                  const PixelWeights<Weight>& weights,
                  std::array<Sum, PoseGrid::kHeadings>& sums) {
  const int columns = observed.columns();
  for (int heading = 0; heading < PoseGrid::kHeadings; ++heading) {
    const int shift = heading * columns / PoseGrid::kHeadings;
    Sum sum{0};
    for (int r = 0; r < observed.rows(); ++r) {
      for (int c = 0; c < columns; ++c) {
        const int turned = c < shift ? c - shift + columns : c - shift;
        sum +=
            weights.values[static_cast<std::size_t>(observed.at(r, c)) * 256 + view.at(r, turned)];
      }
    }
    sums[static_cast<std::size_t>(heading)] = sum;
  }
}

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
  PixelWeights<float> real;
  PixelWeights<std::int32_t> whole;
  std::vector<Sums> sums = std::vector<Sums>(kSlowCells);
  std::vector<std::array<float, PoseGrid::kHeadings>> real_sums =
      std::vector<std::array<float, PoseGrid::kHeadings>>(kSlowCells);
  Part floats = {};
  Part integers = {};

  void round(const LabelImage& observed) {
    floats.run([&] {
      for (std::size_t i = 0; i < kSlowCells; ++i) {
        score_pixels(observed, pixels[i], real, real_sums[i]);
      }
    });
    integers.run([&] {
      for (std::size_t i = 0; i < kSlowCells; ++i) {
        score_pixels(observed, pixels[i], whole, sums[i]);
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

int run(const std::string& folder) {
  service::SiteConfig config;
  config.threads = 1;
  const auto site = must(service::Site::open(folder, config));
  const ClassTable& classes = site->map().classes;
  const PanoramaCamera& camera = site->profile().camera;
  const auto weights = must(similarity::read_weight_matrix(folder + "/weights.csv"));
  const std::vector<CellIndex> free = site->cells().free_cells();
  Rng rng(1, "bench_score");
  std::vector<CellIndex> cells;
  for (std::size_t i = 0; i < kCells; ++i) cells.push_back(free[rng.below(free.size())]);
  const ViewBatch views = must(site->views().views(cells));
  const Observation observation = observe(*site, cells[0]);
  const Observation seen_60 = narrowed(observation, 60);
  const auto prepare = [&](const Observation& seen) {
    return must(similarity::PreparedObservation::build(seen, weights, classes, camera));
  };
  Scorer whole{prepare(observation)};
  Scorer narrow{prepare(seen_60)};
  Loops loops{.real = {weights, classes, 1.0},
              .whole = {weights, classes, static_cast<double>(whole.prepared.weight_scale())}};
  for (std::size_t i = 0; i < kSlowCells; ++i) {
    loops.pixels.push_back(views.views[i]->to_labels(0));
  }

  Part build;
  Part read;
  const std::size_t bytes = table_bytes_of(views);
  const std::size_t words = whole.prepared.byte_size() / 2048 * 256;
  const auto memory = hwy::AllocateAligned<std::uint64_t>(words);
  std::fill_n(memory.get(), words, 1U);
  std::uint64_t sum = 0;
  for (int round = 0; round < kRounds; ++round) {
    whole.round(views);
    loops.round(observation.labels);
    narrow.round(views);
    read.run([&] { sum += benchmark::read_bytes({memory.get(), words}, bytes); });
    build.run([&] { sum += static_cast<std::uint64_t>(prepare(observation).weight_scale()); });
  }
  const bool equal = std::ranges::equal(loops.sums, std::span(whole.sums).first(kSlowCells));
  fmt::print("{}: views of {}x{}, {} classes, one thread\n",
             folder,
             camera.columns,
             camera.rows,
             classes.size());
  print(whole, narrow, loops, read.us_a_view(kCells));
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
  return semview::run(argc > 1 ? argv[1] : SEMVIEW_SOURCE_DIR "/maps/duplex_level1");
}
