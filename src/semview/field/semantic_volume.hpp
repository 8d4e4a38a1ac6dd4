// SPDX-License-Identifier: Apache-2.0
/// A truncated signed distance field with classes.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "semview/core/result.hpp"
#include "semview/semantics/class_table.hpp"

namespace semview::field {

struct VolumeShape {
  double voxel_m = 0.05;  ///< edge of a voxel, in [0.005, 1]
  /// Distances are kept in [-truncation, truncation]; at least two voxels. The paper's tool has
  /// five voxels.
  double truncation_m = 0.20;

  bool operator==(const VolumeShape&) const = default;
};

/// @errors kInvalidArgument: out of range; `Error::field` names it.
Status validate(const VolumeShape& shape);

/// Voxel (x, y, z) covers [x·v, (x+1)·v) × [y·v, (y+1)·v) × [z·v, (z+1)·v) of frame `map`.
struct VoxelIndex {
  int x = 0;
  int y = 0;
  int z = 0;

  auto operator<=>(const VoxelIndex&) const = default;
};

/// How often a class was seen at each voxel of a block.
struct ClassCounts {
  ClassId label = kNoHit;
  std::array<std::uint16_t, 512> count{};  ///< stays at 65535
};

/// 8 × 8 × 8 voxels, x fastest, then y, then z.
struct VoxelBlock {
  static constexpr int kSide = 8;
  static constexpr std::size_t kVoxels = 512;

  std::array<float, kVoxels> sdf_m{};   ///< positive before a surface, negative behind it
  std::array<float, kVoxels> weight{};  ///< 0: never observed
  std::vector<ClassCounts> counts;      ///< of the classes seen in this block, by id
  /// Red, green and blue of each voxel, weighted means in [0, 255]; empty without colour.
  std::vector<Eigen::Vector3f> colour;
  std::vector<float> colour_weight;

  /// The class seen most often there, the lowest id of equals; `kNoHit` where none was seen.
  ClassId most_likely_class(std::size_t voxel) const;
  void count(std::size_t voxel, ClassId label, std::uint16_t times);
};

/// Sparse: blocks exist where something was measured.
///
/// @threads Const members from several threads at once.
class SemanticVolume {
 public:
  using BlockIndex = VoxelIndex;  ///< of blocks, in units of 8 voxels

  SemanticVolume(const VolumeShape& shape, ClassTable classes);

  const VolumeShape& shape() const { return shape_; }
  const ClassTable& classes() const { return classes_; }

  /// The voxel that contains a point of frame `map`.
  VoxelIndex voxel_at(const Eigen::Vector3d& point_map) const;
  Eigen::Vector3d centre(const VoxelIndex& voxel) const;

  static BlockIndex block_of(const VoxelIndex& voxel);
  static std::size_t place_in_block(const VoxelIndex& voxel);
  static VoxelIndex voxel_of(const BlockIndex& block, std::size_t place);

  std::size_t block_count() const { return blocks_.size(); }
  /// All blocks in order of their indices, so that what is made of them is the same each time.
  std::vector<BlockIndex> block_indices() const;
  /// Null where nothing was measured.
  const VoxelBlock* block(const BlockIndex& index) const;
  VoxelBlock* block(const BlockIndex& index);
  /// Makes the block if it is not there.
  VoxelBlock& add_block(const BlockIndex& index);

  /// Weight 0 where never observed.
  float weight(const VoxelIndex& voxel) const;
  /// Meaningful where `weight` > 0.
  float sdf_m(const VoxelIndex& voxel) const;
  ClassId most_likely_class(const VoxelIndex& voxel) const;

 private:
  struct IndexHash {
    std::size_t operator()(const BlockIndex& index) const;
  };

  VolumeShape shape_;
  ClassTable classes_;
  std::unordered_map<BlockIndex, std::unique_ptr<VoxelBlock>, IndexHash> blocks_;
};

/// Blocks a volume may have: some 8 GB with a few classes.
inline constexpr std::size_t kMaxBlocks = 1'000'000;

}  // namespace semview::field
