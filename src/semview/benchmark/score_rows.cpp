// SPDX-License-Identifier: Apache-2.0
// Ways to score a view at all 120 headings.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include <fmt/format.h>

#include "semview/benchmark/measurement.hpp"
#include "semview/benchmark/peer.hpp"
#include "semview/benchmark/pixel_scorer.hpp"
#include "semview/benchmark/read_bytes.hpp"
#include "semview/benchmark/scoring_task.hpp"

namespace semview::benchmark::detail {
namespace {

using IntegerSums = HeadingSums<std::int32_t>;

/// The largest difference of two similarities of one view and heading, in similarity.
template <typename Sums>
double worst_difference(const ScoringTask& task, const IntegerSums& ours, const Sums& other) {
  double worst = 0.0;
  for (std::size_t k = 0; k < ours.size(); ++k) {
    const double theirs = static_cast<double>(other[k]) / task.prepared.observed_pixels();
    worst = std::max(worst, std::abs(task.prepared.similarity(ours[k]) - theirs));
  }
  return worst;
}

IntegerSums compass(const ScoringTask& task, std::size_t view) {
  IntegerSums sums{};
  task.prepared.all_headings(task.views[view], sums);
  return sums;
}

/// Half a unit of the last integer, and what float additions of that many pixels lose.
double tolerance(const ScoringTask& task) { return 0.5 / task.prepared.weight_scale() + 1e-4; }

Status disagree(const std::string& with, double worst) {
  return fail(ErrorCode::kInternal,
              fmt::format("results differ: similarities of {} by {:.2g}", with, worst));
}

Status compass_and_float_loop(const Circumstances& in, Row& row) {
  SEMVIEW_TRY(const ScoringTask task, scoring_task(in.subject, in.camera, in.extent.cells));
  const ClassTable& classes = in.subject.map->classes;
  const PixelWeights<float> real(task.weights, classes, classes, 1.0);
  const PixelWeights<std::int32_t> whole(
      task.weights, classes, classes, task.prepared.weight_scale());
  const std::size_t slow = std::min(in.extent.slow_cells, task.views.size());
  std::vector<LabelImage> pixels;
  double worst = 0.0;
  for (std::size_t i = 0; i < slow; ++i) {
    pixels.push_back(task.views[i].to_labels(0));
    const IntegerSums ours = compass(task, i);
    if (ours !=
        score_pixels<std::int32_t, std::int32_t>(task.observation.labels, pixels[i], whole)) {
      return fail(ErrorCode::kInternal, "results differ: integer sums of runs and of pixels");
    }
    worst = std::max(
        worst,
        worst_difference(
            task, ours, score_pixels<float, float>(task.observation.labels, pixels[i], real)));
  }
  if (worst > tolerance(task)) return disagree("the float loop", worst);
  std::vector<IntegerSums> our_sums;
  std::vector<HeadingSums<float>> other_sums;
  const Turns turns = take_turns(
      keeping(task.views.size(), our_sums, [&](std::size_t i) { return compass(task, i); }),
      keeping(slow,
              other_sums,
              [&](std::size_t i) {
                return score_pixels<float, float>(task.observation.labels, pixels[i], real);
              }),
      in.pool,
      in.extent.turns);
  row.found = finding_of(
      turns, fmt::format("sums equal those of integer pixels, floats within {:.1g}", worst));
  return {};
}

/// The weight of each map class under each pixel of the observation.
WeightImages weight_images(const ScoringTask& task, const ClassTable& classes) {
  const PixelWeights<float> weights(task.weights, classes, classes, 1.0);
  const LabelImage& labels = task.observation.labels;
  WeightImages images;
  for (int map_class = 0; map_class <= classes.size(); ++map_class) {
    Image<float> image(labels.rows(), labels.columns());
    for (std::size_t i = 0; i < labels.pixels().size(); ++i) {
      image.pixels()[i] = weights.at(labels.pixels()[i], static_cast<ClassId>(map_class));
    }
    images.push_back(std::move(image));
  }
  return images;
}

Status compass_and_match_template(const Circumstances& in, Row& row) {
  SEMVIEW_TRY(const ScoringTask task, scoring_task(in.subject, in.camera, in.extent.cells));
  const auto peer = open_match_peer(weight_images(task, in.subject.map->classes));
  if (!peer) return without_peer(peer.error(), row);
  const std::size_t slow = std::min(in.extent.slow_cells, task.views.size());
  std::vector<LabelImage> pixels;
  double worst = 0.0;
  for (std::size_t i = 0; i < slow; ++i) {
    pixels.push_back(task.views[i].to_labels(0));
    worst = std::max(worst, worst_difference(task, compass(task, i), (*peer)->headings(pixels[i])));
  }
  if (worst > tolerance(task)) return disagree("matchTemplate", worst);
  std::vector<IntegerSums> our_sums;
  std::vector<std::vector<float>> other_sums;
  const Turns turns = take_turns(
      keeping(task.views.size(), our_sums, [&](std::size_t i) { return compass(task, i); }),
      keeping(slow, other_sums, [&](std::size_t i) { return (*peer)->headings(pixels[i]); }),
      in.pool,
      in.extent.turns);
  row.found = finding_of(turns, fmt::format("similarities within {:.1g}", worst));
  return {};
}

/// The compass beside reading alone: a run of a view adds the difference of two table rows, and the
/// first row of a column is all zeros; read from a memory as large as the table, in order.
Status compass_and_reading(const Circumstances& in, Row& row) {
  SEMVIEW_TRY(const ScoringTask task, scoring_task(in.subject, in.camera, in.extent.cells));
  constexpr std::size_t kRow_bytes = PoseGrid::kHeadings * sizeof(std::int16_t);
  std::vector<std::size_t> bytes;
  for (const ColumnView& view : task.views) {
    const std::size_t edges = 2 * view.runs().size() - static_cast<std::size_t>(view.columns());
    bytes.push_back(edges * kRow_bytes);
  }
  struct alignas(64) Line {
    std::array<std::uint64_t, 8> words{};
  };
  const std::vector<Line> memory((task.prepared.byte_size() / 256 + 1) * 4);
  const std::span<const std::uint64_t> words(memory.front().words.data(), memory.size() * 8);
  std::vector<IntegerSums> our_sums;
  std::vector<std::uint64_t> read;
  const std::size_t views = task.views.size();
  const Turns turns =
      take_turns(keeping(views, our_sums, [&](std::size_t i) { return compass(task, i); }),
                 keeping(views, read, [&](std::size_t i) { return read_bytes(words, bytes[i]); }),
                 in.pool,
                 in.extent.turns);
  row.found = finding_of(turns, fmt::format("{} kB a view", bytes.front() / 1000));
  row.found->ratio = 1.0 / row.found->ratio;
  row.found->ratio_median = 1.0 / row.found->ratio_median;
  return {};
}

}  // namespace

std::vector<RowKind> score_rows() {
  return {
      {"compass",
       "compass of a view; naive float loop",
       {at_least(264.0, 400.0)},
       Plans::kAll,
       false,
       compass_and_float_loop},
      {"bound",
       "compass of a view; reading as many bytes of table",
       {{"at most 3.5x, then 2x", 3.5, 2.0, true}},
       Plans::kFirst,
       false,
       compass_and_reading},
      {"template",
       "compass of a view; OpenCV matchTemplate",
       {},
       Plans::kFirst,
       true,
       compass_and_match_template},
  };
}

}  // namespace semview::benchmark::detail
