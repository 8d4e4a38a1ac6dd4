// SPDX-License-Identifier: Apache-2.0
#include "label_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "raw_classes.hpp"
#include "semview/core/random.hpp"
#include "smooth_field.hpp"

namespace semview::paper2017 {
namespace {

constexpr int kCandidates = 4;

/// What a class is taken for, the likelier first.
const std::array<RawClass, kCandidates>& confusions(RawClass label) {
  using enum RawClass;
  using Row = std::array<RawClass, kCandidates>;
  static const std::array<Row, kRawClassCount> kRows = {{
      {kCabinet, kDoor, kCurtain, kWindowpane},     // wall
      {kWall, kTable, kBox, kDesk},                 // floor
      {kWall, kLight, kWindowpane, kWall},          // ceiling
      {kCabinet, kWall, kWindowpane, kShelf},       // door
      {kWall, kCurtain, kPainting, kDoor},          // windowpane
      {kDesk, kCabinet, kChair, kChestOfDrawers},   // table
      {kTable, kCabinet, kChestOfDrawers, kShelf},  // desk
      {kChair, kBox, kTable, kDesk},                // swivel chair
      {kSwivelChair, kTable, kBox, kDesk},          // chair
      {kWall, kDoor, kShelf, kChestOfDrawers},      // cabinet
      {kCabinet, kWall, kDoor, kPainting},          // shelf
      {kCabinet, kTable, kDesk, kBox},              // chest of drawers
      {kCabinet, kTable, kWall, kChestOfDrawers},   // sink
      {kPoster, kWindowpane, kWall, kMonitor},      // painting
      {kPainting, kWall, kWindowpane, kDoor},       // poster
      {kCeiling, kWall, kWindowpane, kCeiling},     // light
      {kWall, kWindowpane, kCabinet, kDoor},        // curtain
      {kWall, kCabinet, kBox, kChestOfDrawers},     // radiator
      {kPainting, kBox, kWindowpane, kCabinet},     // monitor
      {kCabinet, kChestOfDrawers, kFloor, kTable},  // box
      {kCurtain, kWall, kPerson, kBox},             // plant
      {kChair, kCabinet, kCurtain, kDoor},          // person
  }};
  return kRows[static_cast<std::size_t>(label) - 1];
}

/// The first is taken in half of the cases, the next in half of the others, and so on.
RawClass mistaken(RawClass label, Rng& rng) {
  std::size_t rank = 0;
  while (rank + 1 < kCandidates && rng.uniform() < 0.5) ++rank;
  return confusions(label)[rank];
}

/// Objects called by another name: some by every view, some by this one.
void rename_objects(LabelImage& labels,
                    const SceneView& view,
                    double share,
                    std::uint64_t world_seed,
                    std::uint64_t view_seed) {
  std::unordered_map<std::int64_t, RawClass> names;
  for (int row = 0; row < labels.rows(); ++row) {
    for (int column = 0; column < labels.columns(); ++column) {
      const std::int32_t object = view.objects.at(row, column);
      if (object <= 0) continue;
      const auto label = static_cast<RawClass>(view.labels.at(row, column));
      const std::int64_t key = std::int64_t{object} * 256 + labels.at(row, column);
      auto found = names.find(key);
      if (found == names.end()) {
        RawClass name = label;
        const auto index = static_cast<std::uint64_t>(key);
        Rng always(world_seed, "misnamed-always", index);
        Rng here(view_seed, "misnamed-here", index);
        if (always.uniform() < share / 2.0) {
          name = mistaken(label, always);
        } else if (here.uniform() < share / 2.0) {
          name = mistaken(label, here);
        }
        found = names.emplace(key, name).first;
      }
      labels.at(row, column) = static_cast<ClassId>(found->second);
    }
  }
}

/// Patches of wall, floor and ceiling called something else, one name a patch class.
void add_patches(
    LabelImage& labels, const SceneView& view, double share, double patch_px, Rng& rng) {
  if (!(share > 0.0)) return;
  for (const RawClass structure : {RawClass::kWall, RawClass::kFloor, RawClass::kCeiling}) {
    const SmoothField field(labels.rows(), labels.columns(), patch_px, rng);
    const SmoothField names(labels.rows(), labels.columns(), 3.0 * patch_px, rng);
    std::vector<double> values;
    for (int row = 0; row < labels.rows(); ++row) {
      for (int column = 0; column < labels.columns(); ++column) {
        if (view.labels.at(row, column) == static_cast<ClassId>(structure) &&
            view.objects.at(row, column) == 0) {
          values.push_back(field.at(row, column));
        }
      }
    }
    if (values.empty()) continue;
    const auto rank = static_cast<std::ptrdiff_t>((1.0 - std::min(share, 1.0)) *
                                                  static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, values.begin() + rank);
    const double threshold = values[static_cast<std::size_t>(rank)];
    for (int row = 0; row < labels.rows(); ++row) {
      for (int column = 0; column < labels.columns(); ++column) {
        if (view.labels.at(row, column) != static_cast<ClassId>(structure) ||
            view.objects.at(row, column) != 0 || field.at(row, column) <= threshold) {
          continue;
        }
        // The second field picks the name, so that neighbours agree.
        const double pick = names.at(row, column);
        const std::size_t name = pick > 0.5 ? 0 : (pick > 0.0 ? 1 : (pick > -0.5 ? 2 : 3));
        labels.at(row, column) = static_cast<ClassId>(confusions(structure)[name]);
      }
    }
  }
}

LabelImage shift_borders(const LabelImage& labels, double shift_px, double wave_px, Rng& rng) {
  if (!(shift_px > 0.0)) return labels;
  const SmoothField down(labels.rows(), labels.columns(), wave_px, rng);
  const SmoothField right(labels.rows(), labels.columns(), wave_px, rng);
  LabelImage shifted = labels;
  for (int row = 0; row < labels.rows(); ++row) {
    for (int column = 0; column < labels.columns(); ++column) {
      const auto from = [&](const SmoothField& field, int at, int size) {
        const auto offset = static_cast<int>(std::lround(shift_px * field.at(row, column)));
        return std::clamp(at + offset, 0, size - 1);
      };
      shifted.at(row, column) =
          labels.at(from(down, row, labels.rows()), from(right, column, labels.columns()));
    }
  }
  return shifted;
}

void add_salt(LabelImage& labels, double share, Rng& rng) {
  for (ClassId& label : labels.pixels()) {
    if (rng.uniform() < share) label = static_cast<ClassId>(1 + rng.below(kRawClassCount));
  }
}

}  // namespace

LabelImage misread(const SceneView& view,
                   double pixel_rad,
                   const LabelNoiseConfig& config,
                   std::uint64_t world_seed,
                   std::uint64_t view_seed) {
  LabelImage labels = view.labels;
  rename_objects(
      labels, view, std::min(1.0, config.object_error * config.level), world_seed, view_seed);
  Rng patches(view_seed, "patches");
  add_patches(labels,
              view,
              config.patch_share * config.level,
              std::max(1.0, config.patch_rad / pixel_rad),
              patches);
  Rng borders(view_seed, "borders");
  labels = shift_borders(labels,
                         config.border_shift_rad * config.level / pixel_rad,
                         std::max(1.0, config.border_wave_rad / pixel_rad),
                         borders);
  Rng salt(view_seed, "salt");
  add_salt(labels, config.salt_share * config.level, salt);
  return labels;
}

}  // namespace semview::paper2017
