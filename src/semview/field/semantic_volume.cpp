// SPDX-License-Identifier: Apache-2.0
#include "semview/field/semantic_volume.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace semview::field {
namespace {

constexpr int kShift = 3;  // log2 of a block's side
constexpr int kMask = VoxelBlock::kSide - 1;

}  // namespace

Status validate(const VolumeShape& shape) {
  if (!(shape.voxel_m >= 0.005 && shape.voxel_m <= 1.0)) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("voxel of {} m: expected 0.005 to 1", shape.voxel_m),
                      "voxel"});
  }
  if (!(shape.truncation_m >= 2.0 * shape.voxel_m && shape.truncation_m <= 100.0)) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("truncation distance of {} m: expected two voxels ({} m) or more",
                                  shape.truncation_m,
                                  2.0 * shape.voxel_m),
                      "truncation"});
  }
  return {};
}

ClassId VoxelBlock::most_likely_class(std::size_t voxel) const {
  ClassId best = kNoHit;
  std::uint16_t most = 0;
  for (const ClassCounts& layer : counts) {
    if (layer.count[voxel] > most) {
      most = layer.count[voxel];
      best = layer.label;
    }
  }
  return best;
}

void VoxelBlock::count(std::size_t voxel, ClassId label, std::uint16_t times) {
  auto layer = std::ranges::lower_bound(counts, label, {}, &ClassCounts::label);
  if (layer == counts.end() || layer->label != label) {
    layer = counts.insert(layer, ClassCounts{label, {}});
  }
  const int sum = layer->count[voxel] + times;
  layer->count[voxel] =
      static_cast<std::uint16_t>(std::min<int>(sum, std::numeric_limits<std::uint16_t>::max()));
}

SemanticVolume::SemanticVolume(const VolumeShape& shape, ClassTable classes)
    : shape_(shape), classes_(std::move(classes)) {}

VoxelIndex SemanticVolume::voxel_at(const Eigen::Vector3d& point_map) const {
  return {static_cast<int>(std::floor(point_map.x() / shape_.voxel_m)),
          static_cast<int>(std::floor(point_map.y() / shape_.voxel_m)),
          static_cast<int>(std::floor(point_map.z() / shape_.voxel_m))};
}

Eigen::Vector3d SemanticVolume::centre(const VoxelIndex& voxel) const {
  return shape_.voxel_m * Eigen::Vector3d(voxel.x + 0.5, voxel.y + 0.5, voxel.z + 0.5);
}

SemanticVolume::BlockIndex SemanticVolume::block_of(const VoxelIndex& voxel) {
  return {voxel.x >> kShift, voxel.y >> kShift, voxel.z >> kShift};
}

std::size_t SemanticVolume::place_in_block(const VoxelIndex& voxel) {
  return static_cast<std::size_t>((voxel.x & kMask) | (voxel.y & kMask) << kShift |
                                  (voxel.z & kMask) << (2 * kShift));
}

VoxelIndex SemanticVolume::voxel_of(const BlockIndex& block, std::size_t place) {
  const int p = static_cast<int>(place);
  return {block.x * VoxelBlock::kSide + (p & kMask),
          block.y * VoxelBlock::kSide + (p >> kShift & kMask),
          block.z * VoxelBlock::kSide + (p >> (2 * kShift))};
}

std::vector<SemanticVolume::BlockIndex> SemanticVolume::block_indices() const {
  std::vector<BlockIndex> indices;
  indices.reserve(blocks_.size());
  for (const auto& [index, block] : blocks_) indices.push_back(index);
  std::ranges::sort(indices);
  return indices;
}

const VoxelBlock* SemanticVolume::block(const BlockIndex& index) const {
  const auto found = blocks_.find(index);
  return found == blocks_.end() ? nullptr : found->second.get();
}

VoxelBlock* SemanticVolume::block(const BlockIndex& index) {
  const auto found = blocks_.find(index);
  return found == blocks_.end() ? nullptr : found->second.get();
}

VoxelBlock& SemanticVolume::add_block(const BlockIndex& index) {
  std::unique_ptr<VoxelBlock>& block = blocks_[index];
  if (!block) block = std::make_unique<VoxelBlock>();
  return *block;
}

float SemanticVolume::weight(const VoxelIndex& voxel) const {
  const VoxelBlock* found = block(block_of(voxel));
  return found == nullptr ? 0.0F : found->weight[place_in_block(voxel)];
}

float SemanticVolume::sdf_m(const VoxelIndex& voxel) const {
  const VoxelBlock* found = block(block_of(voxel));
  return found == nullptr ? 0.0F : found->sdf_m[place_in_block(voxel)];
}

ClassId SemanticVolume::most_likely_class(const VoxelIndex& voxel) const {
  const VoxelBlock* found = block(block_of(voxel));
  return found == nullptr ? kNoHit : found->most_likely_class(place_in_block(voxel));
}

std::size_t SemanticVolume::IndexHash::operator()(const BlockIndex& index) const {
  // Three odd numbers with well mixed bits: neighbours fall far apart.
  return static_cast<std::size_t>(index.x) * 0x9E3779B97F4A7C15U ^
         static_cast<std::size_t>(index.y) * 0xC2B2AE3D27D4EB4FU ^
         static_cast<std::size_t>(index.z) * 0x165667B19E3779F9U;
}

}  // namespace semview::field
