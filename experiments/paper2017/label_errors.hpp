// SPDX-License-Identifier: Apache-2.0
/// How well the simulated network names what the camera sees, and how far the plan is from the
/// world: what a reader needs to judge the experiment.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "raw_classes.hpp"
#include "scene.hpp"
#include "world.hpp"

namespace semview::paper2017 {

/// Pixels by true class (first) and named class, both counted from 0 as `raw_classes()`.
class LabelErrors {
 public:
  /// Pixels where nothing is to be seen are left out.
  void add(const LabelImage& truth, const LabelImage& labels);

  std::int64_t count(int truth, int named) const;
  double pixel_accuracy() const;
  /// Intersection over union; NaN of a class that neither is there nor is named.
  double iou(int label) const;
  /// Over the classes that are there.
  double mean_iou() const;

 private:
  std::array<std::int64_t, std::size_t{kRawClassCount} * kRawClassCount> counts_{};
};

/// How far, on average, a true border between two classes is from the nearest border that the
/// network draws, in pixels; those farther than `reach_px` count as that far.
double border_error_px(std::span<const World> worlds, int reach_px);

/// Counts over worlds.
struct WorldDifferences {
  int furniture = 0;
  int missing_in_map = 0;
  int missing_in_world = 0;
  int chairs = 0;
  double chair_shift_m = 0.0;  ///< mean distance from where they are drawn
  int doors = 0;
  int doors_in_other_state = 0;
  int unmapped_things = 0;
};
WorldDifferences differences_of(std::span<const World> worlds);

}  // namespace semview::paper2017
