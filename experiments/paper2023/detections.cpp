// SPDX-License-Identifier: Apache-2.0
#include "detections.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "experiments/paper2017/smooth_field.hpp"
#include "semview/core/random.hpp"
#include "things.hpp"

namespace semview::paper2023 {
namespace {

/// What a class is taken for, the likelier first.
ThingClass confusion(ThingClass label, std::size_t rank) {
  using enum ThingClass;
  static constexpr std::array<std::array<ThingClass, 2>, kThingClassCount> kRows = {{
      {kSofa, kTable},            // chair
      {kBed, kChair},             // sofa
      {kSofa, kTable},            // bed
      {kCabinet, kChair},         // table
      {kBox, kCabinet},           // television
      {kLamp, kBox},              // plant
      {kCabinet, kShelf},         // refrigerator
      {kCabinet, kTable},         // sink
      {kShelf, kRefrigerator},    // cabinet
      {kCabinet, kRefrigerator},  // shelf
      {kPlant, kChair},           // lamp
      {kCabinet, kChair},         // box
  }};
  return kRows[static_cast<std::size_t>(label) - 1][rank];
}

/// Whether something of this share happens, half always and half here.
bool happens(double share, double always, double here) {
  const double half = 1.0 - std::sqrt(1.0 - share);
  return always < half || here < half;
}

/// What the detector makes of one object in one view.
ClassId named(std::int32_t object,
              ClassId label,
              const DetectorConfig& config,
              std::uint64_t always_seed,
              std::uint64_t view_seed) {
  const auto index = static_cast<std::uint64_t>(object) * 256 + label;
  Rng always(always_seed, "detected-always", index);
  Rng here(view_seed, "detected-here", index);
  const double missed_always = always.uniform();
  if (happens(config.missed, missed_always, here.uniform())) return kUnknown;
  const double mistaken_always = always.uniform();
  if (!happens(config.mistaken, mistaken_always, here.uniform())) return label;
  const std::size_t rank = always.uniform() < 0.7 ? 0 : 1;
  return static_cast<ClassId>(confusion(static_cast<ThingClass>(label), rank));
}

LabelImage loosen(const LabelImage& labels, double shift_px, double wave_px, Rng& rng) {
  const paper2017::SmoothField down(labels.rows(), labels.columns(), wave_px, rng);
  const paper2017::SmoothField right(labels.rows(), labels.columns(), wave_px, rng);
  LabelImage loose = labels;
  const auto moved = [&](int at, double share, int size) {
    return std::clamp(at + static_cast<int>(std::lround(shift_px * share)), 0, size - 1);
  };
  for (int row = 0; row < labels.rows(); ++row) {
    for (int column = 0; column < labels.columns(); ++column) {
      loose.at(row, column) = labels.at(moved(row, down.at(row, column), labels.rows()),
                                        moved(column, right.at(row, column), labels.columns()));
    }
  }
  return loose;
}

}  // namespace

std::string_view name(LabelSource source) { return source == LabelSource::kGt ? "gt" : "rcnn"; }

LabelImage true_labels(const RgbdTruth& truth) {
  LabelImage labels = truth.labels;
  std::ranges::replace(labels.pixels(), kNoHit, kUnknown);
  return labels;
}

LabelImage detect(const RgbdTruth& truth,
                  const DetectorConfig& config,
                  std::uint64_t always_seed,
                  std::uint64_t view_seed) {
  LabelImage labels = true_labels(truth);
  std::map<std::pair<std::int32_t, ClassId>, ClassId> names;
  for (std::size_t i = 0; i < labels.pixels().size(); ++i) {
    ClassId& label = labels.pixels()[i];
    if (label == kUnknown) continue;
    const std::int32_t object = truth.objects.pixels()[i];
    const auto [found, is_new] = names.try_emplace({object, label}, label);
    if (is_new) found->second = named(object, label, config, always_seed, view_seed);
    label = found->second;
  }
  const double scale = labels.columns() / 640.0;
  Rng borders(view_seed, "borders");
  return loosen(labels,
                config.border_at_640_px * scale,
                std::max(1.0, config.wave_at_640_px * scale),
                borders);
}

}  // namespace semview::paper2023
