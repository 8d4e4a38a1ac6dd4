// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/dense_posterior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/localization/low_variance_resampling.hpp"

namespace semview::observation {
namespace {

constexpr int kHeadings = PoseGrid::kHeadings;
/// Cells a call: half a megabyte of sums, and few enough that casting their views on a busy server
/// ends within a robot's patience.
constexpr std::size_t kCellsPerCall = 1024;
/// Peaks of a smaller weight, relative to the highest, are no modes.
constexpr double kLeastPeak = 1e-3;

int turned(int heading, int by) { return (heading + by + kHeadings) % kHeadings; }

int headings_apart(int a, int b) {
  const int difference = std::abs(a - b);
  return std::min(difference, kHeadings - difference);
}

/// A square of cells and an arc of headings that hold all that is as near as `config` says.
struct Reach {
  double radius_m;
  int cells;
  int headings;

  explicit Reach(const localization::ModeConfig& config)
      : radius_m(config.radius_m),
        cells(static_cast<int>(std::floor(config.radius_m / PoseGrid::kCellSize_m + 1e-9))),
        headings(std::min(kHeadings / 2,
                          static_cast<int>(std::floor(
                              config.heading_radius_rad / (2.0 * kPi) * kHeadings + 1e-9)))) {}

  bool holds(const GridKey& a, const GridKey& b) const {
    return headings_apart(a.heading, b.heading) <= headings &&
           distance_m(PoseGrid::center(a.cell), PoseGrid::center(b.cell)) <= radius_m + 1e-9;
  }
};

}  // namespace

Result<DensePosterior> DensePosterior::compute(ScoreSource& source,
                                               const SimilarityWeightingConfig& config,
                                               std::vector<CellIndex> cells,
                                               const Pose2& base_from_eye,
                                               const SearchProgress& progress,
                                               const MapAffine& affine) {
  std::ranges::sort(cells);
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  if (cells.empty()) return fail(ErrorCode::kInvalidArgument, "dense posterior: no cells");
  if (cells.size() > kMaxPosteriorCells) {
    return fail(
        ErrorCode::kResourceExhausted,
        fmt::format(
            "dense posterior: {} cells, expected at most {}", cells.size(), kMaxPosteriorCells));
  }
  DensePosterior posterior;
  posterior.config_ = config;
  posterior.eye_from_base_ = inverse(base_from_eye);
  posterior.cells_ = std::move(cells);
  posterior.sums_.reserve(posterior.cells_.size() * kHeadings);
  ScoreRequest request;
  request.mode = HeadingMode::kCompass;
  request.whole_curve = true;
  for (std::size_t first = 0; first < posterior.cells_.size(); first += kCellsPerCall) {
    const std::size_t end = std::min(first + kCellsPerCall, posterior.cells_.size());
    request.poses.clear();
    for (std::size_t i = first; i < end; ++i) {
      request.poses.push_back(PoseGrid::center(posterior.cells_[i]));
    }
    if (!affine.is_identity()) request.affines.assign(end - first, affine);
    SEMVIEW_TRY(const ScoreBatch batch, source.score(request));
    SEMVIEW_TRY_STATUS(posterior.take(batch, end - first));
    if (progress && !progress(end, posterior.cells_.size())) {
      return fail(ErrorCode::kCancelled, "dense posterior: cancelled");
    }
  }
  posterior.weigh();
  return posterior;
}

Status DensePosterior::take(const ScoreBatch& batch, std::size_t cells) {
  const bool same_scale = sums_.empty() || (batch.weight_scale == weight_scale_ &&
                                            batch.observed_pixels == observed_pixels_);
  if (batch.curve.size() != cells * kHeadings || batch.weight_scale < 1 ||
      batch.observed_pixels < 1 || !same_scale) {
    return fail(ErrorCode::kInternal,
                fmt::format("the score source answered {} sums of {} cells (scale {}, {} observed "
                            "pixels), expected {} a cell, of one scale",
                            batch.curve.size(),
                            cells,
                            batch.weight_scale,
                            batch.observed_pixels,
                            kHeadings));
  }
  weight_scale_ = batch.weight_scale;
  observed_pixels_ = batch.observed_pixels;
  sums_.insert(sums_.end(), batch.curve.begin(), batch.curve.end());
  scores_.origins += batch.origins;
  return {};
}

void DensePosterior::weigh() {
  const auto similarity = [this](double sum) {
    return sum / (static_cast<double>(weight_scale_) * static_cast<double>(observed_pixels_));
  };
  cell_weights_.assign(cells_.size(), 0.0);
  std::int32_t highest = kNoView;
  double best_of_cells = 0.0;  // integers: exact in any order
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const std::int32_t best = *std::ranges::max_element(curve(i));
    highest = std::max(highest, best);
    if (best == kNoView) {
      ++scores_.without_view;
    } else {
      best_of_cells += best;
    }
  }
  if (highest == kNoView) return;
  scores_.best_similarity = similarity(highest);
  scores_.mean_similarity =
      similarity(best_of_cells / static_cast<double>(cells_.size() - scores_.without_view));
  highest_log_weight_ = log_weight(config_, scores_.best_similarity);
  if (!std::isfinite(highest_log_weight_)) return;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    for (const std::int32_t sum : curve(i)) cell_weights_[i] += weight(sum);
    total_ += cell_weights_[i];
  }
}

std::span<const std::int32_t> DensePosterior::curve(std::size_t cell) const {
  return std::span(sums_).subspan(cell * kHeadings, kHeadings);
}

double DensePosterior::weight(std::int32_t sum) const {
  if (sum == kNoView) return 0.0;
  const double similarity = static_cast<double>(sum) / (static_cast<double>(weight_scale_) *
                                                        static_cast<double>(observed_pixels_));
  return std::exp(log_weight(config_, similarity) - highest_log_weight_);
}

double DensePosterior::probability(std::size_t cell, int heading) const {
  return informative() ? weight(curve(cell)[static_cast<std::size_t>(heading)]) / total_ : 0.0;
}

/// Calls visit(cell, heading) for what is within `cells` cells in x and y and `headings` headings.
template <typename Visit>
void DensePosterior::around(const GridKey& center,
                            int cells,
                            int headings,
                            const Visit& visit) const {
  const int most = std::min(headings, kHeadings - 1 - headings);  // no heading twice
  for (int dy = -cells; dy <= cells; ++dy) {
    const CellIndex first{center.cell.ix - cells, center.cell.iy + dy};
    const CellIndex last{center.cell.ix + cells, center.cell.iy + dy};
    for (auto cell = std::ranges::lower_bound(cells_, first); cell != cells_.end() && *cell <= last;
         ++cell) {
      const auto index = static_cast<std::size_t>(cell - cells_.begin());
      for (int turn = -headings; turn <= most; ++turn) visit(index, turned(center.heading, turn));
    }
  }
}

bool DensePosterior::is_peak(std::size_t cell, int heading) const {
  const std::int32_t own = curve(cell)[static_cast<std::size_t>(heading)];
  bool peak = true;
  around({cells_[cell], heading}, 1, 1, [&](std::size_t i, int k) {
    const std::int32_t other = curve(i)[static_cast<std::size_t>(k)];
    // Of equal neighbours the first is the peak.
    if (other > own || (other == own && std::pair(i, k) < std::pair(cell, heading))) peak = false;
  });
  return peak;
}

std::vector<PosteriorMode> DensePosterior::modes(std::size_t most,
                                                 const localization::ModeConfig& config) const {
  if (!informative()) return {};
  std::vector<std::tuple<std::int32_t, std::size_t, int>> peaks;  // -sum, cell, heading
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const auto sums = curve(i);
    for (int k = 0; k < kHeadings; ++k) {
      const std::int32_t sum = sums[static_cast<std::size_t>(k)];
      // The curve's own peaks first, they are few.
      if (sum < sums[static_cast<std::size_t>(turned(k, 1))] ||
          sum < sums[static_cast<std::size_t>(turned(k, -1))] || !(weight(sum) >= kLeastPeak)) {
        continue;
      }
      if (is_peak(i, k)) peaks.emplace_back(-sum, i, k);
    }
  }
  std::ranges::sort(peaks);

  const Reach reach(config);
  std::vector<GridKey> centers;
  const auto taken = [&](const GridKey& key) {
    return std::ranges::any_of(centers, [&](const GridKey& c) { return reach.holds(c, key); });
  };
  std::vector<PosteriorMode> modes;
  for (const auto& [negative_sum, cell, heading] : peaks) {
    if (modes.size() == most) break;
    const GridKey center{cells_[cell], heading};
    if (taken(center)) continue;
    PosteriorMode mode;
    mode.map_from_robot = PoseGrid::center(center) * eye_from_base_;
    mode.similarity = -static_cast<double>(negative_sum) /
                      (static_cast<double>(weight_scale_) * static_cast<double>(observed_pixels_));
    around(center, reach.cells, reach.headings, [&](std::size_t i, int k) {
      const GridKey key{cells_[i], k};
      if (reach.holds(center, key) && !taken(key)) mode.probability += probability(i, k);
    });
    centers.push_back(center);
    modes.push_back(mode);
  }
  return modes;
}

localization::ParticleSet DensePosterior::draw(std::size_t count, Rng& rng) const {
  SEMVIEW_CHECK(informative() && count > 0);
  constexpr double kHalfCell_m = PoseGrid::kCellSize_m / 2.0;
  constexpr double kHalfHeading_rad = kPi / kHeadings;
  localization::ParticleSet particles;
  particles.reserve(count);
  for (const std::uint32_t cell : localization::low_variance_sample(cell_weights_, count, rng)) {
    const auto sums = curve(cell);
    double mark = rng.uniform(0.0, cell_weights_[cell]);
    int heading = 0;
    // The last possible heading if rounding leaves something over.
    for (int k = 0; k < kHeadings && mark >= 0.0; ++k) {
      const double share = weight(sums[static_cast<std::size_t>(k)]);
      if (share > 0.0) heading = k;
      mark -= share;
    }
    Pose2 eye = PoseGrid::center(GridKey{cells_[cell], heading});
    eye.x_m += rng.uniform(-kHalfCell_m, kHalfCell_m);
    eye.y_m += rng.uniform(-kHalfCell_m, kHalfCell_m);
    eye.yaw_rad = wrap_angle(eye.yaw_rad + rng.uniform(-kHalfHeading_rad, kHalfHeading_rad));
    localization::Particle particle;
    particle.map_from_robot = eye * eye_from_base_;
    particle.heading_rad = particle.map_from_robot.yaw_rad;
    particle.weight = 1.0 / static_cast<double>(count);
    particles.push_back(particle);
  }
  return particles;
}

}  // namespace semview::observation
