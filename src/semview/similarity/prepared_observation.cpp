// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/prepared_observation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/similarity/integer_weights.hpp"
#include "semview/similarity/run_sweep.hpp"

namespace semview::similarity {
namespace {

constexpr int kHeadings = PoseGrid::kHeadings;
constexpr std::int32_t kMaxScale = 400;
constexpr double kMaxEntry = std::numeric_limits<std::int16_t>::max();

/// The largest scale for which a column of the heaviest weight stays within 16 bits.
std::int32_t scale_for(double max_abs_weight, int rows) {
  auto scale = static_cast<std::int32_t>(
      std::min<double>(kMaxScale, std::floor(kMaxEntry / (rows * std::max(max_abs_weight, 1e-9)))));
  // Rounding a weight up may cost the last unit: 1024 rows of 0.5 · 63 → 32 are one too much.
  while (scale > 0 && std::round(max_abs_weight * scale) * rows > kMaxEntry) --scale;
  return scale;
}

struct Extent {
  std::int32_t pixels = 0;
  int first_column = std::numeric_limits<int>::max();
  int last_column = -1;
};

Result<Extent> observed_extent(const Observation& observation) {
  Extent extent;
  const LabelImage& labels = observation.labels;
  for (int r = 0; r < labels.rows(); ++r) {
    for (int c = 0; c < labels.columns(); ++c) {
      const ClassId label = labels.at(r, c);
      if (!is_scored(label)) continue;
      if (label > observation.classes.size()) {
        return fail(
            ErrorCode::kInvalidArgument,
            fmt::format("observation: label {} at row {}, column {}, expected 1 to {} or {}",
                        label,
                        r,
                        c,
                        observation.classes.size(),
                        kUnknown));
      }
      ++extent.pixels;
      extent.first_column = std::min(extent.first_column, c);
      extent.last_column = std::max(extent.last_column, c);
    }
  }
  if (extent.pixels == 0) {
    return fail(ErrorCode::kInvalidArgument,
                "observation: every pixel is unknown, nothing to score");
  }
  return extent;
}

Status check_shape(const Observation& observation, const PanoramaCamera& camera) {
  if (camera.rows < 1 || camera.columns < kHeadings || camera.columns % kHeadings != 0) {
    return fail(
        ErrorCode::kInvalidArgument,
        fmt::format(
            "panorama of {} columns: expected a multiple of {}", camera.columns, kHeadings));
  }
  if (observation.labels.rows() != camera.rows || observation.labels.columns() != camera.columns) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("observation of {} x {} pixels, expected the view profile's {} x {}",
                            observation.labels.columns(),
                            observation.labels.rows(),
                            camera.columns,
                            camera.rows));
  }
  return {};
}

}  // namespace

Result<PreparedObservation> PreparedObservation::build(const Observation& observation,
                                                       const WeightMatrix& weights,
                                                       const ClassTable& map_classes,
                                                       const PanoramaCamera& camera) {
  SEMVIEW_TRY_STATUS(check_shape(observation, camera));
  SEMVIEW_TRY(const Extent extent, observed_extent(observation));
  SEMVIEW_TRY_STATUS(weights.check(observation.classes, map_classes));

  PreparedObservation prepared;
  prepared.observed_pixels_ = extent.pixels;
  prepared.weight_scale_ = scale_for(weights.max_abs_weight(), camera.rows);
  if (prepared.weight_scale_ < 1) {
    return fail(ErrorCode::kFailedPrecondition,
                fmt::format("weights: {:g} is too large, expected at most {:g} with {} rows",
                            weights.max_abs_weight(),
                            std::floor(kMaxEntry / camera.rows),
                            camera.rows));
  }
  const int residues = camera.columns / kHeadings;
  const int first_group = extent.first_column / residues;
  const int groups = extent.last_column / residues - first_group + 1;
  const int classes = static_cast<int>(map_classes.size()) + 1;
  const std::size_t bytes = PrefixTable::bytes_for(camera.rows, camera.columns, classes, groups);
  if (bytes > kMaxTableBytes) {
    return fail(
        ErrorCode::kResourceExhausted,
        fmt::format("observation: tables of {} bytes for {} map classes, expected at most {}",
                    bytes,
                    map_classes.size(),
                    kMaxTableBytes));
  }

  SEMVIEW_TRY(
      const IntegerWeights integers,
      integer_weights(weights, prepared.weight_scale_, observation.classes, map_classes, camera));
  prepared.table_ = PrefixTable(camera.rows, camera.columns, classes, first_group, groups);
  prepared.table_.fill(observation.labels, integers.of_row);
  return prepared;
}

bool PreparedObservation::fits(const ColumnView& view) const {
  if (view.columns() != table_.residues() * kHeadings || view.rows() != table_.rows()) return false;
  int largest = 0;
  for (const Run& run : view.runs()) largest = std::max<int>(largest, run.label);
  return largest < table_.classes();
}

std::int32_t PreparedObservation::sum(const ColumnView& view, int heading) const {
  SEMVIEW_ASSERT(fits(view) && heading >= 0 && heading < kHeadings);
  return sum_runs(table_, view, heading);
}

void PreparedObservation::all_headings(const ColumnView& view,
                                       std::span<std::int32_t, kHeadings> sums) const {
  SEMVIEW_ASSERT(fits(view));
  sweep_runs(table_, view, sums);
}

void PreparedObservation::some_headings(const ColumnView& view,
                                        std::span<const std::uint8_t> headings,
                                        std::span<std::int32_t> sums) const {
  SEMVIEW_ASSERT(headings.size() == sums.size());
  if (sweep_pays(headings.size())) {
    std::array<std::int32_t, kHeadings> all{};
    all_headings(view, all);
    std::ranges::transform(headings, sums.begin(), [&all](std::uint8_t k) { return all[k]; });
  } else {
    std::ranges::transform(
        headings, sums.begin(), [&](std::uint8_t k) { return sum(view, static_cast<int>(k)); });
  }
}

bool PreparedObservation::sweep_pays(std::size_t headings) const {
  // Measured in the time that one heading takes for one group of columns: 17 ns, where a sweep
  // takes 1.3 us and 0.7 us for each 32 groups (bench/RESULTS.md).
  constexpr std::size_t kSweep = 80;
  constexpr std::size_t kSweepOfBlock = 40;
  return headings * static_cast<std::size_t>(table_.groups()) >
         kSweep + kSweepOfBlock * table_.width() / PrefixTable::kBlock;
}

}  // namespace semview::similarity
