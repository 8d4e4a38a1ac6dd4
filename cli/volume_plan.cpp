// SPDX-License-Identifier: Apache-2.0
#include "volume_plan.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "semview/picture/class_palette.hpp"

namespace semview::cli {
namespace {

constexpr Rgb kWhite{255, 255, 255};

struct Highest {
  int z = 0;
  ClassId label = kNoHit;
};

/// By column (x, y) of voxels.
using Columns = std::map<std::pair<int, int>, Highest>;

Columns columns_of(const field::SemanticVolume& volume, int top_z) {
  Columns columns;
  for (const field::VoxelIndex& index : volume.block_indices()) {
    const field::VoxelBlock& block = *volume.block(index);
    if (block.counts.empty()) continue;
    for (std::size_t place = 0; place < field::VoxelBlock::kVoxels; ++place) {
      const ClassId label = block.most_likely_class(place);
      const field::VoxelIndex voxel = field::SemanticVolume::voxel_of(index, place);
      if (label == kNoHit || voxel.z >= top_z) continue;
      const auto [found, added] = columns.try_emplace({voxel.x, voxel.y}, Highest{voxel.z, label});
      if (!added && voxel.z > found->second.z) found->second = {voxel.z, label};
    }
  }
  return columns;
}

}  // namespace

picture::ClassPlanPicture volume_plan(const field::SemanticVolume& volume,
                                      double ground_height_m,
                                      double top_m) {
  const double voxel_m = volume.shape().voxel_m;
  const Columns columns =
      columns_of(volume, static_cast<int>(std::floor((ground_height_m + top_m) / voxel_m)));
  picture::ClassPlanPicture drawing;
  if (columns.empty()) return drawing;
  int low_x = columns.begin()->first.first;
  int high_x = low_x;
  int low_y = columns.begin()->first.second;
  int high_y = low_y;
  for (const auto& [at, highest] : columns) {
    low_x = std::min(low_x, at.first);
    high_x = std::max(high_x, at.first);
    low_y = std::min(low_y, at.second);
    high_y = std::max(high_y, at.second);
  }
  const auto palette = picture::ClassPalette::for_classes(volume.classes());
  drawing.plan.image = RgbImage(high_y - low_y + 1, high_x - low_x + 1, kWhite);
  for (const auto& [at, highest] : columns) {
    drawing.plan.image.at(high_y - at.second, at.first - low_x) = palette[highest.label];
  }
  drawing.plan.resolution_m = voxel_m;
  drawing.plan.origin = {low_x * voxel_m, low_y * voxel_m, 0.0};
  for (int c = 1; c <= volume.classes().size(); ++c) {
    const auto label = static_cast<ClassId>(c);
    drawing.classes.push_back({palette[label], std::string(volume.classes().name(label))});
  }
  return drawing;
}

}  // namespace semview::cli
