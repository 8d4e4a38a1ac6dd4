// SPDX-License-Identifier: Apache-2.0
// What it costs to score a view at all 120 headings: `bench_score MAP` (default:
// maps/duplex_level1).
//
// The scorer on runs, the naive loop over pixels with real weights, and the same loop in integers
// take turns in one process and thread on the same views, which the loops get as pixels for free.
// The least time of each is printed: on a busy machine only the ratios are worth reading. Ends with
// exit code 1 if the scorer's sums are not those of the integer loop.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "semview/core/random.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/service/site.hpp"
#include "semview/similarity/prepared_observation.hpp"

namespace semview {
namespace {

constexpr std::size_t kCells = 16;
constexpr int kRounds = 10;

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
  double microseconds_a_view() const { return 1e6 * least_s / static_cast<double>(kCells); }
};

/// w[observed][map], the rows that are not scored all 0: the loops need no branch for them.
template <typename Weight>
struct PixelWeights {
  std::vector<Weight> values = std::vector<Weight>(std::size_t{256} * 256, Weight{0});

  PixelWeights(const similarity::WeightMatrix& weights, const ClassTable& classes, double scale) {
    const auto index = [](const auto& names, std::string_view name) {
      return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    };
    for (std::size_t o = 1; o <= classes.size(); ++o) {
      const std::size_t row =
          index(weights.observed_names(), classes.name(static_cast<ClassId>(o)));
      for (std::size_t m = 0; m <= classes.size(); ++m) {
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

int run(const std::string& folder) {
  service::SiteConfig config;
  config.threads = 1;
  const auto site = must(service::Site::open(folder, config));
  const ClassTable& classes = site->map().classes;
  const auto weights = must(similarity::read_weight_matrix(folder + "/weights.csv"));
  const std::vector<CellIndex> free = site->cells().free_cells();
  Rng rng(1, "bench_score");
  std::vector<CellIndex> cells;
  for (std::size_t i = 0; i < kCells; ++i) cells.push_back(free[rng.below(free.size())]);
  const ViewBatch views = must(site->views().views(cells));
  const Observation observation = observe(*site, cells[0]);
  const auto prepared = must(similarity::PreparedObservation::build(
      observation, weights, classes, site->profile().camera));
  std::vector<LabelImage> pixels;
  for (const SharedView& view : views.views) pixels.push_back(view->to_labels(0));
  const PixelWeights<float> real(weights, classes, 1.0);
  const PixelWeights<std::int32_t> whole(weights, classes, prepared.weight_scale());

  std::vector<Sums> by_runs(kCells);
  std::vector<Sums> by_pixels(kCells);
  std::vector<std::array<float, PoseGrid::kHeadings>> by_floats(kCells);
  Part runs;
  Part integers;
  Part floats;
  for (int round = 0; round < kRounds; ++round) {
    runs.run([&] {
      for (std::size_t i = 0; i < kCells; ++i) prepared.all_headings(*views.views[i], by_runs[i]);
    });
    floats.run([&] {
      for (std::size_t i = 0; i < kCells; ++i) {
        score_pixels(observation.labels, pixels[i], real, by_floats[i]);
      }
    });
    integers.run([&] {
      for (std::size_t i = 0; i < kCells; ++i) {
        score_pixels(observation.labels, pixels[i], whole, by_pixels[i]);
      }
    });
  }
  fmt::print("{} views of {}x{}, {} classes, all {} headings of each:\n",
             kCells,
             observation.labels.columns(),
             observation.labels.rows(),
             classes.size(),
             PoseGrid::kHeadings);
  fmt::print("  runs            {:9.1f} us a view\n", runs.microseconds_a_view());
  fmt::print("  float pixels    {:9.1f} us a view, {:.0f}x\n",
             floats.microseconds_a_view(),
             floats.least_s / runs.least_s);
  fmt::print("  integer pixels  {:9.1f} us a view, {:.0f}x, {}\n",
             integers.microseconds_a_view(),
             integers.least_s / runs.least_s,
             by_runs == by_pixels ? "equal sums" : "DIFFERENT SUMS");
  fmt::print(
      "  (the float loop's best similarity {:.4f}, the runs' {:.4f})\n",
      *std::ranges::max_element(by_floats[0]) / static_cast<float>(prepared.observed_pixels()),
      prepared.similarity(*std::ranges::max_element(by_runs[0])));
  return by_runs == by_pixels ? 0 : 1;
}

}  // namespace
}  // namespace semview

int main(int argc, char** argv) {
  return semview::run(argc > 1 ? argv[1] : SEMVIEW_SOURCE_DIR "/maps/duplex_level1");
}
