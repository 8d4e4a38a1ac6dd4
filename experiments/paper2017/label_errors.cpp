// SPDX-License-Identifier: Apache-2.0
#include "label_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "semview/geometry/pose2.hpp"

namespace semview::paper2017 {
namespace {

std::size_t index_of(int truth, int named) {
  return static_cast<std::size_t>(truth) * kRawClassCount + static_cast<std::size_t>(named);
}

bool is_border(const LabelImage& labels, int row, int column) {
  const ClassId label = labels.at(row, column);
  return (row + 1 < labels.rows() && labels.at(row + 1, column) != label) ||
         (column + 1 < labels.columns() && labels.at(row, column + 1) != label);
}

/// To the nearest border of `labels`, at most `reach_px`.
double distance_to_border(const LabelImage& labels, int row, int column, int reach_px) {
  double least = reach_px;
  for (int r = std::max(0, row - reach_px); r <= std::min(labels.rows() - 1, row + reach_px); ++r) {
    for (int c = std::max(0, column - reach_px);
         c <= std::min(labels.columns() - 1, column + reach_px);
         ++c) {
      if (!is_border(labels, r, c)) continue;
      least = std::min(least, std::hypot(r - row, c - column));
    }
  }
  return least;
}

}  // namespace

void LabelErrors::add(const LabelImage& truth, const LabelImage& labels) {
  for (int row = 0; row < truth.rows(); ++row) {
    for (int column = 0; column < truth.columns(); ++column) {
      const ClassId there = truth.at(row, column);
      const ClassId named = labels.at(row, column);
      if (there == kNoHit || named == kNoHit) continue;
      ++counts_[index_of(there - 1, named - 1)];
    }
  }
}

std::int64_t LabelErrors::count(int truth, int named) const {
  return counts_[index_of(truth, named)];
}

double LabelErrors::pixel_accuracy() const {
  std::int64_t right = 0;
  std::int64_t all = 0;
  for (int truth = 0; truth < kRawClassCount; ++truth) {
    right += count(truth, truth);
    for (int named = 0; named < kRawClassCount; ++named) all += count(truth, named);
  }
  return static_cast<double>(right) / static_cast<double>(all);
}

double LabelErrors::iou(int label) const {
  std::int64_t either = -count(label, label);
  for (int other = 0; other < kRawClassCount; ++other) {
    either += count(label, other) + count(other, label);
  }
  if (either == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(count(label, label)) / static_cast<double>(either);
}

double LabelErrors::mean_iou() const {
  double sum = 0.0;
  int classes = 0;
  for (int label = 0; label < kRawClassCount; ++label) {
    std::int64_t there = 0;
    for (int named = 0; named < kRawClassCount; ++named) there += count(label, named);
    if (there == 0) continue;
    sum += iou(label);
    ++classes;
  }
  return sum / classes;
}

double border_error_px(std::span<const World> worlds, int reach_px) {
  double sum = 0.0;
  std::int64_t borders = 0;
  for (const World& world : worlds) {
    for (const Stop& stop : world.stops) {
      const LabelImage& truth = stop.truth.labels;
      for (int row = 0; row < truth.rows(); ++row) {
        for (int column = 0; column < truth.columns(); ++column) {
          if (!is_border(truth, row, column)) continue;
          sum += distance_to_border(stop.labels, row, column, reach_px);
          ++borders;
        }
      }
    }
  }
  return sum / static_cast<double>(borders);
}

WorldDifferences differences_of(std::span<const World> worlds) {
  WorldDifferences all;
  for (const World& world : worlds) {
    for (const Furniture& piece : world.layout.furniture) {
      ++all.furniture;
      if (!piece.in_map) ++all.missing_in_map;
      if (!piece.in_world) ++all.missing_in_world;
      if (piece.kind != FurnitureKind::kChair && piece.kind != FurnitureKind::kSwivelChair)
        continue;
      ++all.chairs;
      all.chair_shift_m += distance_m(piece.pose, piece.drawn_pose);
    }
    for (const Opening& opening : world.layout.openings) {
      if (opening.kind != OpeningKind::kDoor) continue;
      ++all.doors;
      if ((opening.leaf_angle_rad > 0.0) != opening.drawn_open) ++all.doors_in_other_state;
    }
    all.unmapped_things += static_cast<int>(world.layout.clutter.size());
  }
  if (all.chairs > 0) all.chair_shift_m /= all.chairs;
  return all;
}

}  // namespace semview::paper2017
