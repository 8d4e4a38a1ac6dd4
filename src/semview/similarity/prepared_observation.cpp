// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/prepared_observation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "semview/core/check.hpp"

namespace semview::similarity {
namespace {

constexpr int kHeadings = PoseGrid::kHeadings;
constexpr std::int32_t kMaxScale = 400;
constexpr double kMaxEntry = std::numeric_limits<std::int16_t>::max();
/// Columns swept at once: six 128-bit registers, the fastest of 16 to 64 columns with plain SSE2.
constexpr int kBlock = 48;

/// Eight 16-bit lanes, an extension of GCC and Clang that also compiles where there is no such
/// register. Unsigned, so that sums may wrap on the way to one that fits.
using Lanes = std::uint16_t __attribute__((vector_size(16)));
constexpr int kLanes = 8;

Lanes load(const std::int16_t* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}

/// The largest scale for which a column of the heaviest weight stays within 16 bits.
std::int32_t scale_for(double max_abs_weight, int rows) {
  auto scale = static_cast<std::int32_t>(
      std::min<double>(kMaxScale, std::floor(kMaxEntry / (rows * std::max(max_abs_weight, 1e-9)))));
  // Rounding a weight up may cost the last unit: 1024 rows of 0.5 · 63 → 32 are one too much.
  while (scale > 0 && std::round(max_abs_weight * scale) * rows > kMaxEntry) --scale;
  return scale;
}

/// Integer weights [label][map class] of a band; labels that are not scored have zeros.
std::vector<std::int16_t> integer_weights(const WeightMatrix& weights,
                                          std::size_t band,
                                          std::int32_t scale,
                                          const ClassTable& observed,
                                          const ClassTable& map) {
  const auto position = [](std::span<const std::string> names, std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  const auto map_classes = static_cast<std::size_t>(map.size()) + 1;
  std::vector<std::size_t> column_of(map_classes, position(weights.map_names(), kNoneColumn));
  for (std::size_t j = 1; j < map_classes; ++j) {
    column_of[j] = position(weights.map_names(), map.names()[j - 1]);
  }
  std::vector<std::int16_t> integers(256 * map_classes, 0);
  for (std::size_t i = 1; i <= observed.names().size(); ++i) {
    const std::size_t row = position(weights.observed_names(), observed.names()[i - 1]);
    for (std::size_t j = 0; j < map_classes; ++j) {
      integers[i * map_classes + j] =
          static_cast<std::int16_t>(std::lround(weights.weight(band, row, column_of[j]) * scale));
    }
  }
  return integers;
}

std::optional<std::size_t> band_at(const WeightMatrix& weights, double elevation_deg) {
  for (std::size_t b = 0; b < weights.bands().size(); ++b) {
    const WeightMatrix::Band& band = weights.bands()[b];
    if (elevation_deg >= band.elevation_min_deg && elevation_deg < band.elevation_max_deg) return b;
  }
  return {};
}

struct Extent {
  std::int32_t pixels = 0;
  int first_column = std::numeric_limits<int>::max();
  int last_column = -1;
};

bool is_scored(ClassId label) { return label != kNoHit && label != kUnknown; }

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
  prepared.rows_ = camera.rows;
  prepared.columns_ = camera.columns;
  prepared.map_classes_ = map_classes.size() + 1;
  prepared.residues_ = camera.columns / kHeadings;
  prepared.first_ = extent.first_column / prepared.residues_;
  const int blocks = (extent.last_column / prepared.residues_ - prepared.first_) / kBlock + 1;
  prepared.width_ = blocks * kBlock;
  prepared.observed_pixels_ = extent.pixels;
  prepared.weight_scale_ = scale_for(weights.max_abs_weight(), camera.rows);
  if (prepared.weight_scale_ < 1) {
    return fail(ErrorCode::kFailedPrecondition,
                fmt::format("weights: {:g} is too large, expected at most {:g} with {} rows",
                            weights.max_abs_weight(),
                            std::floor(kMaxEntry / camera.rows),
                            camera.rows));
  }
  const std::size_t entries = (static_cast<std::size_t>(camera.rows) + 1) * prepared.row_stride();
  if (entries * sizeof(std::int16_t) > kMaxTableBytes) {
    return fail(
        ErrorCode::kResourceExhausted,
        fmt::format("observation: tables of {} bytes for {} map classes, expected at most {}",
                    entries * sizeof(std::int16_t),
                    map_classes.size(),
                    kMaxTableBytes));
  }

  std::vector<std::vector<std::int16_t>> of_band;
  for (std::size_t b = 0; b < weights.bands().size(); ++b) {
    of_band.push_back(
        integer_weights(weights, b, prepared.weight_scale_, observation.classes, map_classes));
  }
  std::vector<const std::int16_t*> of_row;
  for (int r = 0; r < camera.rows; ++r) {
    const double elevation_deg = deg_from_rad(camera.elevation_rad(r));
    const std::optional<std::size_t> band = band_at(weights, elevation_deg);
    if (!band) {
      return fail(ErrorCode::kFailedPrecondition,
                  fmt::format("weights: no band for elevation {:g} degrees of the view profile",
                              elevation_deg));
    }
    of_row.push_back(of_band[*band].data());
  }
  prepared.table_.assign(entries, 0);
  prepared.fill(observation.labels, of_row);
  return prepared;
}

void PreparedObservation::fill(const LabelImage& labels,
                               std::span<const std::int16_t* const> weights_of_row) {
  const auto classes = static_cast<std::size_t>(map_classes_);
  for (int r = 0; r < rows_; ++r) {
    const std::int16_t* const above = table_.data() + static_cast<std::size_t>(r) * row_stride();
    std::int16_t* const below = table_.data() + (static_cast<std::size_t>(r) + 1) * row_stride();
    std::copy_n(above, row_stride(), below);
    for (int c = 0; c < columns_; ++c) {
      const ClassId label = labels.at(r, c);
      if (!is_scored(label)) continue;
      const std::int16_t* const weight =
          weights_of_row[static_cast<std::size_t>(r)] + label * classes;
      std::int16_t* const column = below + (c % residues_) * width_ + (c / residues_ - first_);
      for (std::size_t j = 0; j < classes; ++j) {
        std::int16_t& entry = column[j * class_stride()];
        entry = static_cast<std::int16_t>(entry + weight[j]);
      }
    }
  }
}

bool PreparedObservation::fits(const ColumnView& view) const {
  if (view.columns() != columns_ || view.rows() != rows_) return false;
  int largest = 0;
  for (const Run& run : view.runs()) largest = std::max<int>(largest, run.label);
  return largest < map_classes_;
}

std::int32_t PreparedObservation::sum(const ColumnView& view, int heading) const {
  SEMVIEW_ASSERT(fits(view) && heading >= 0 && heading < kHeadings);
  std::int32_t total = 0;
  const int last = std::min(first_ + width_, kHeadings);
  for (int q = first_; q < last; ++q) {
    const int map_q = q >= heading ? q - heading : q - heading + kHeadings;
    for (int residue = 0; residue < residues_; ++residue) {
      const std::int16_t* const column = table_.data() + residue * width_ + (q - first_);
      std::size_t above = 0;
      for (const Run& run : view.column(map_q * residues_ + residue)) {
        const std::size_t below = run.end_row * row_stride();
        const std::size_t label = run.label * class_stride();
        total += column[below + label] - column[above + label];
        above = below;
      }
    }
  }
  return total;
}

void PreparedObservation::all_headings(const ColumnView& view,
                                       std::span<std::int32_t, kHeadings> sums) const {
  SEMVIEW_ASSERT(fits(view));
  // Heading k of map column group q meets the observed group q + k (mod 120). Summed without the
  // modulo, at [q_observed - q + 120], and folded at the end.
  alignas(64) std::array<std::int32_t, 2 * kHeadings + kBlock> unfolded{};
  const std::size_t rows_apart = row_stride();
  const std::size_t classes_apart = class_stride();
  for (int q = 0; q < kHeadings; ++q) {
    for (int block = 0; block < width_; block += kBlock) {
      std::array<std::int32_t, kBlock> group{};
      for (int residue = 0; residue < residues_; ++residue) {
        const std::int16_t* const table = table_.data() + residue * width_ + block;
        std::array<Lanes, kBlock / kLanes> lanes{};
        std::size_t above = 0;
        for (const Run& run : view.column(q * residues_ + residue)) {
          const std::size_t label = run.label * classes_apart;
          const std::size_t below = run.end_row * rows_apart;
          const std::int16_t* const from = table + above + label;
          const std::int16_t* const to = table + below + label;
          for (std::size_t i = 0; i < lanes.size(); ++i) {
            lanes[i] += load(to + i * kLanes) - load(from + i * kLanes);
          }
          above = below;
        }
        std::array<std::int16_t, kBlock> column{};
        std::memcpy(column.data(), lanes.data(), sizeof(column));
        for (std::size_t i = 0; i < kBlock; ++i) group[i] += column[i];
      }
      std::int32_t* const target = unfolded.data() + (first_ + block - q + kHeadings);
      for (std::size_t i = 0; i < kBlock; ++i) target[i] += group[i];
    }
  }
  for (std::size_t k = 0; k < kHeadings; ++k) sums[k] = unfolded[k] + unfolded[k + kHeadings];
}

}  // namespace semview::similarity
