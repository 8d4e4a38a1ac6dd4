// SPDX-License-Identifier: Apache-2.0
#include "semview/simulation/photograph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "semview/core/check.hpp"
#include "semview/geometry/angle.hpp"

namespace semview::simulation {
namespace {

/// A smooth random field over directions.
class Waves {
 public:
  Waves(double wave_rad, Rng& rng) {
    const int highest = std::max(1, static_cast<int>(std::lround(kPi / wave_rad)));
    for (Wave& wave : waves_) {
      // Whole turns, so that the left edge of a panorama continues the right one.
      wave.turns = static_cast<double>(rng.below(static_cast<std::uint64_t>(highest)) + 1);
      wave.rises = rng.uniform(-1.0, 1.0) * highest;
      wave.phase = rng.uniform(0.0, kTwoPi);
    }
  }

  double at(double azimuth_rad, double elevation_rad) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) {
      sum += std::cos(wave.turns * azimuth_rad + wave.rises * elevation_rad + wave.phase);
    }
    return sum;
  }

 private:
  struct Wave {
    double turns = 1.0;
    double rises = 0.0;
    double phase = 0.0;
  };
  std::array<Wave, 16> waves_{};
};

struct Patch {
  double row = 0.0;
  double column = 0.0;
  double draw = 0.0;  ///< in [0, 1): which of a class's wrong classes
};

ClassId wrong_class(const ClassFate& fate, double draw) {
  double all = 0.0;
  for (const auto& [label, often] : fate.instead) all += often;
  double mark = draw * all;
  for (const auto& [label, often] : fate.instead) {
    mark -= often;
    if (mark < 0.0) return label;
  }
  return fate.instead.empty() ? kUnknown : fate.instead.back().first;
}

/// Pitch and roll shift what is at an azimuth up or down.
LabelImage tilted(const LabelImage& truth,
                  const LabelGeometry& geometry,
                  double tilt_rad,
                  Rng& rng) {
  const double pitch_rad = rng.normal(0.0, tilt_rad);
  const double roll_rad = rng.normal(0.0, tilt_rad);
  LabelImage labels(truth.rows(), truth.columns());
  for (int c = 0; c < truth.columns(); ++c) {
    const double azimuth_rad = c * geometry.column_rad;
    const auto rows = static_cast<int>(std::lround(
        (pitch_rad * std::cos(azimuth_rad) + roll_rad * std::sin(azimuth_rad)) / geometry.row_rad));
    for (int r = 0; r < truth.rows(); ++r) {
      labels.at(r, c) = truth.at(std::clamp(r + rows, 0, truth.rows() - 1), c);
    }
  }
  return labels;
}

double quality(const PhotographConfig& config, Rng& rng) {
  const double kind = rng.uniform();
  const double fair = rng.uniform(0.4, 0.95);
  if (kind < config.poor_share) return 0.1;
  return kind < config.poor_share + config.fair_share ? fair : 1.0;
}

/// Up to which value of the field each class is seen right.
std::vector<double> limits(const LabelImage& labels,
                           const Image<double>& field,
                           const std::vector<ClassFate>& fates,
                           const PhotographConfig& config,
                           Rng& rng) {
  std::vector<std::vector<double>> values(fates.size());
  for (int r = 0; r < labels.rows(); ++r) {
    for (int c = 0; c < labels.columns(); ++c) values[labels.at(r, c)].push_back(field.at(r, c));
  }
  const double share = quality(config, rng);
  std::vector<double> limits(fates.size(), 0.0);
  for (std::size_t k = 0; k < fates.size(); ++k) {
    const double recall =
        std::clamp((fates[k].recall + rng.normal(0.0, config.recall_spread)) * share, 0.0, 1.0);
    if (values[k].empty()) continue;
    const auto right = static_cast<std::ptrdiff_t>(recall * static_cast<double>(values[k].size()));
    if (right == static_cast<std::ptrdiff_t>(values[k].size())) {
      limits[k] = INFINITY;
      continue;
    }
    std::nth_element(values[k].begin(), values[k].begin() + right, values[k].end());
    limits[k] = values[k][static_cast<std::size_t>(right)];
  }
  return limits;
}

std::vector<Patch> scatter(const LabelImage& labels, int count, Rng& rng) {
  std::vector<Patch> patches;
  for (int k = 0; k < count; ++k) {
    patches.push_back(
        {rng.uniform(0.0, labels.rows()), rng.uniform(0.0, labels.columns()), rng.uniform()});
  }
  return patches;
}

const Patch& nearest(const std::vector<Patch>& patches, int row, int column, int columns) {
  const auto distance2 = [&](const Patch& patch) {
    const double across = std::abs(patch.column - column);
    const double dc = std::min(across, columns - across);
    return dc * dc + (patch.row - row) * (patch.row - row);
  };
  return *std::ranges::min_element(patches, {}, distance2);
}

}  // namespace

LabelImage photograph(const LabelImage& truth,
                      const LabelGeometry& geometry,
                      const std::vector<ClassFate>& fates,
                      const PhotographConfig& config,
                      Rng& rng) {
  SEMVIEW_CHECK(!fates.empty() && config.patches > 0);
  const LabelImage level = tilted(truth, geometry, config.tilt_rad, rng);
  SegmentationNoiseConfig borders;
  borders.blobs_per_sr = 0.0;
  const LabelImage swung = add_segmentation_noise(
      level, geometry, static_cast<int>(fates.size()) - 1, borders, 1.0, rng);
  const Waves waves(config.wave_rad, rng);
  Image<double> field(swung.rows(), swung.columns());
  for (int r = 0; r < swung.rows(); ++r) {
    for (int c = 0; c < swung.columns(); ++c) {
      field.at(r, c) = waves.at(c * geometry.column_rad, r * geometry.row_rad);
    }
  }
  const std::vector<double> right_up_to = limits(swung, field, fates, config, rng);
  const std::vector<Patch> patches = scatter(swung, config.patches, rng);
  LabelImage seen(swung.rows(), swung.columns());
  for (int r = 0; r < swung.rows(); ++r) {
    for (int c = 0; c < swung.columns(); ++c) {
      const ClassId label = swung.at(r, c);
      const ClassFate& fate = fates[label];
      seen.at(r, c) = field.at(r, c) < right_up_to[label]
                          ? fate.right
                          : wrong_class(fate, nearest(patches, r, c, swung.columns()).draw);
    }
  }
  return seen;
}

std::vector<std::string> photograph_classes() {
  return {"other",      "wall",    "building", "sky",    "floor", "tree",    "ceiling", "bed",
          "windowpane", "cabinet", "person",   "door",   "table", "plant",   "curtain", "chair",
          "painting",   "sofa",    "shelf",    "mirror", "rug",   "armchair"};
}

std::vector<ClassFate> photograph_fates(const std::vector<std::string>& class_names) {
  const std::vector<std::string> classes = photograph_classes();
  const auto id = [&](std::string_view name) {
    const auto found = std::ranges::find(classes, name);
    SEMVIEW_CHECK(found != classes.end());
    return static_cast<ClassId>(found - classes.begin() + 1);
  };
  using Wrong = std::vector<std::pair<ClassId, double>>;
  const Wrong of_wall{{id("cabinet"), 3},
                      {id("painting"), 3},
                      {id("windowpane"), 2},
                      {id("curtain"), 2},
                      {id("door"), 2},
                      {id("ceiling"), 2},
                      {id("shelf"), 2},
                      {id("sofa"), 1},
                      {id("mirror"), 1},
                      {id("other"), 2},
                      {id("plant"), 1}};
  const Wrong of_floor{{id("rug"), 3},
                       {id("wall"), 2},
                       {id("table"), 2},
                       {id("chair"), 2},
                       {id("sofa"), 2},
                       {id("bed"), 1},
                       {id("other"), 4},
                       {id("cabinet"), 1}};
  const Wrong of_ceiling{{id("wall"), 8}, {id("other"), 2}, {id("windowpane"), 1}};
  const Wrong of_window{{id("wall"), 4},
                        {id("curtain"), 3},
                        {id("door"), 2},
                        {id("tree"), 1},
                        {id("building"), 1},
                        {id("sky"), 1},
                        {id("mirror"), 1}};
  const Wrong of_door{{id("wall"), 8},
                      {id("cabinet"), 3},
                      {id("windowpane"), 2},
                      {id("floor"), 1},
                      {id("mirror"), 1},
                      {id("other"), 2}};
  const Wrong of_thing{
      {id("other"), 4}, {id("wall"), 3}, {id("floor"), 2}, {id("cabinet"), 2}, {id("table"), 1}};
  std::vector<ClassFate> fates{
      {id("wall"), 0.3, {{id("sky"), 2}, {id("tree"), 1}, {id("windowpane"), 2}}}};
  for (const std::string& name : class_names) {
    ClassFate fate{id("other"), 0.6, of_thing};
    if (name == "wall" || name == "beam") fate = {id("wall"), 0.87, of_wall};
    if (name == "floor") fate = {id("floor"), 0.77, of_floor};
    if (name == "ceiling" || name == "roof") fate = {id("ceiling"), 0.77, of_ceiling};
    if (name == "windowpane" || name == "window") fate = {id("windowpane"), 0.71, of_window};
    if (name == "door") fate = {id("door"), 0.29, of_door};
    if (name == "coffee table" || name == "desk" || name == "table") fate.right = id("table");
    if (name == "countertop") fate.right = id("cabinet");
    const auto same = std::ranges::find(classes, name);
    if (fate.recall == 0.6 && same != classes.end()) fate.right = id(name);
    fates.push_back(std::move(fate));
  }
  return fates;
}

}  // namespace semview::simulation
