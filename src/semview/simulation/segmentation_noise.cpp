// SPDX-License-Identifier: Apache-2.0
#include "semview/simulation/segmentation_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace semview::simulation {
namespace {

/// A smooth random field over an image, standard normal at its nodes.
class WaveField {
 public:
  WaveField(int rows, int columns, const LabelGeometry& geometry, double wave_rad, Rng& rng)
      : full_turn_(geometry.full_turn) {
    const auto nodes = [](double extent) {
      return std::max(1, static_cast<int>(std::lround(extent)));
    };
    rows_ = nodes(rows * geometry.row_rad / wave_rad) + 1;
    columns_ = nodes(columns * geometry.column_rad / wave_rad) + (full_turn_ ? 0 : 1);
    row_step_ = (rows_ - 1.0) / rows;
    column_step_ = (columns_ - (full_turn_ ? 0.0 : 1.0)) / columns;
    for (int k = 0; k < rows_ * columns_; ++k) nodes_.push_back(rng.normal(0.0, 1.0));
  }

  double at(int row, int column) const {
    const double y = (row + 0.5) * row_step_;
    const double x = (column + 0.5) * column_step_;
    const int r = std::min(static_cast<int>(y), rows_ - 2);
    const int c = static_cast<int>(x);
    const double fy = y - r;
    const double fx = x - c;
    return (1.0 - fy) * ((1.0 - fx) * node(r, c) + fx * node(r, c + 1)) +
           fy * ((1.0 - fx) * node(r + 1, c) + fx * node(r + 1, c + 1));
  }

 private:
  double node(int row, int column) const {
    const int c = full_turn_ ? column % columns_ : std::min(column, columns_ - 1);
    return nodes_[static_cast<std::size_t>(row * columns_ + c)];
  }

  bool full_turn_;
  int rows_ = 0;
  int columns_ = 0;
  double row_step_ = 0.0;
  double column_step_ = 0.0;
  std::vector<double> nodes_;
};

int wrapped(int column, int columns, bool full_turn) {
  if (!full_turn) return std::clamp(column, 0, columns - 1);
  return ((column % columns) + columns) % columns;
}

LabelImage shift_edges(const LabelImage& labels,
                       const LabelGeometry& geometry,
                       const SegmentationNoiseConfig& config,
                       double level,
                       Rng& rng) {
  const WaveField across(labels.rows(), labels.columns(), geometry, config.edge_wave_rad, rng);
  const WaveField along(labels.rows(), labels.columns(), geometry, config.edge_wave_rad, rng);
  LabelImage shifted(labels.rows(), labels.columns());
  for (int r = 0; r < labels.rows(); ++r) {
    for (int c = 0; c < labels.columns(); ++c) {
      const double shift_rad = level * config.edge_shift_rad;
      const auto dc =
          static_cast<int>(std::lround(across.at(r, c) * shift_rad / geometry.column_rad));
      const auto dr = static_cast<int>(std::lround(along.at(r, c) * shift_rad / geometry.row_rad));
      shifted.at(r, c) = labels.at(std::clamp(r + dr, 0, labels.rows() - 1),
                                   wrapped(c + dc, labels.columns(), geometry.full_turn));
    }
  }
  return shifted;
}

ClassId wrong_class(const LabelImage& labels,
                    ClassId right,
                    int classes,
                    const SegmentationNoiseConfig& config,
                    Rng& rng) {
  const double draw = rng.uniform();
  if (draw < config.unknown_share || classes < 2) return kUnknown;
  if (draw < config.unknown_share + config.elsewhere_share) {
    const auto other = static_cast<ClassId>(1 + rng.below(static_cast<std::uint64_t>(classes) - 1));
    return other < right ? other : static_cast<ClassId>(other + 1);
  }
  std::array<bool, 256> seen{};
  for (const ClassId label : labels.pixels()) seen[label] = true;
  std::vector<ClassId> others;
  for (int label = 1; label <= classes; ++label) {
    if (seen[static_cast<std::size_t>(label)] && label != right)
      others.push_back(static_cast<ClassId>(label));
  }
  return others.empty() ? kUnknown : others[rng.below(others.size())];
}

void add_blob(LabelImage& labels,
              const LabelGeometry& geometry,
              int classes,
              const SegmentationNoiseConfig& config,
              Rng& rng) {
  const int row = static_cast<int>(rng.below(static_cast<std::uint64_t>(labels.rows())));
  const int column = static_cast<int>(rng.below(static_cast<std::uint64_t>(labels.columns())));
  const double width_rad = rng.uniform(config.min_blob_rad, config.max_blob_rad);
  const double height_rad = rng.uniform(config.min_blob_rad, config.max_blob_rad);
  const WaveField ragged(labels.rows(), labels.columns(), geometry, config.min_blob_rad, rng);
  const ClassId right = labels.at(row, column);
  if (right == kUnknown || right == kNoHit) return;
  const ClassId wrong = wrong_class(labels, right, classes, config, rng);
  const auto reach = [](double size_rad, double pixel_rad) {
    return static_cast<int>(std::ceil(1.5 * size_rad / pixel_rad));
  };
  const int rows = reach(height_rad, geometry.row_rad);
  const int columns = std::min(reach(width_rad, geometry.column_rad), labels.columns() / 2);
  for (int r = std::max(0, row - rows); r < std::min(labels.rows(), row + rows + 1); ++r) {
    for (int dc = -columns; dc <= columns; ++dc) {
      const int c = wrapped(column + dc, labels.columns(), geometry.full_turn);
      const double x = dc * geometry.column_rad / width_rad;
      const double y = (r - row) * geometry.row_rad / height_rad;
      if (labels.at(r, c) == right && x * x + y * y < 1.0 + 0.4 * ragged.at(r, c)) {
        labels.at(r, c) = wrong;
      }
    }
  }
}

}  // namespace

LabelImage add_segmentation_noise(const LabelImage& labels,
                                  const LabelGeometry& geometry,
                                  int classes,
                                  const SegmentationNoiseConfig& config,
                                  double level,
                                  Rng& rng) {
  if (labels.empty() || level <= 0.0) return labels;
  LabelImage noisy = shift_edges(labels, geometry, config, level, rng);
  const double solid_angle_sr =
      labels.columns() * geometry.column_rad * labels.rows() * geometry.row_rad;
  const double expected = level * config.blobs_per_sr * solid_angle_sr;
  const auto blobs = static_cast<int>(expected * rng.uniform(0.5, 1.5) + rng.uniform());
  for (int k = 0; k < blobs; ++k) add_blob(noisy, geometry, classes, config, rng);
  return noisy;
}

}  // namespace semview::simulation
