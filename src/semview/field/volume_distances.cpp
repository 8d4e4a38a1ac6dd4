// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/field/distance_field.hpp"
#include "semview/field/distance_transform.hpp"

namespace semview::field {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kMaxReach_voxels = 255;  // so that squared distances fit 16 bits
constexpr std::uint16_t kOutOfReach = std::numeric_limits<std::uint16_t>::max();

/// Voxels [low, high).
struct VoxelBounds {
  VoxelIndex low{std::numeric_limits<int>::max(),
                 std::numeric_limits<int>::max(),
                 std::numeric_limits<int>::max()};
  VoxelIndex high{std::numeric_limits<int>::min(),
                  std::numeric_limits<int>::min(),
                  std::numeric_limits<int>::min()};

  void include(const VoxelIndex& first, const VoxelIndex& past) {
    low = {std::min(low.x, first.x), std::min(low.y, first.y), std::min(low.z, first.z)};
    high = {std::max(high.x, past.x), std::max(high.y, past.y), std::max(high.z, past.z)};
  }
  VoxelBounds grown_within(int reach, const VoxelBounds& all) const {
    return {{std::max(low.x - reach, all.low.x),
             std::max(low.y - reach, all.low.y),
             std::max(low.z - reach, all.low.z)},
            {std::min(high.x + reach, all.high.x),
             std::min(high.y + reach, all.high.y),
             std::min(high.z + reach, all.high.z)}};
  }
  Box box() const { return {high.x - low.x, high.y - low.y, high.z - low.z}; }
};

/// Squared distances to one class in voxels, in a box outside of which nothing is in reach.
struct ClassBox {
  VoxelBounds bounds;
  std::vector<VoxelIndex> voxels;  ///< of the class; empty once the distances are there
  std::vector<std::uint16_t> squared;
};

class VolumeDistances final : public DistanceField {
 public:
  VolumeDistances(const SemanticVolume& volume, double ground_height_m, int reach, int margin)
      : classes_(volume.classes()),
        shape_(volume.shape()),
        ground_height_m_(ground_height_m),
        reach_(reach),
        boxes_(static_cast<std::size_t>(kMaxClasses) + 1) {
    for (const VoxelIndex& block : volume.block_indices()) {
      const VoxelIndex first = SemanticVolume::voxel_of(block, 0);
      bounds_.include(first, {first.x + kSide, first.y + kSide, first.z + kSide});
    }
    bounds_.low = {bounds_.low.x - margin, bounds_.low.y - margin, bounds_.low.z};
    bounds_.high = {bounds_.high.x + margin, bounds_.high.y + margin, bounds_.high.z};
    const double v = shape_.voxel_m;
    const Box box = bounds_.box();
    grid_ = {{bounds_.low.x * v, bounds_.low.y * v, 0.0}, v, box.nx, box.ny};
  }

  const ClassTable& classes() const override { return classes_; }
  const LayerGrid& grid() const override { return grid_; }
  double ground_height_m() const override { return ground_height_m_; }

  void sample_class(ClassId label, double z_m, std::span<float> squared_m2) const override {
    std::ranges::fill(squared_m2, kInfinity);
    const ClassBox& of = boxes_[label];
    const int z = layer(z_m);
    if (of.squared.empty() || z < of.bounds.low.z || z >= of.bounds.high.z) return;
    const Box box = of.bounds.box();
    const auto voxel_m2 = static_cast<float>(shape_.voxel_m * shape_.voxel_m);
    for (int y = 0; y < box.ny; ++y) {
      const std::uint16_t* from = &of.squared[box.index(0, y, z - of.bounds.low.z)];
      float* to = &squared_m2[place(of.bounds.low.x, of.bounds.low.y + y)];
      for (int x = 0; x < box.nx; ++x) {
        if (from[x] != kOutOfReach) to[x] = voxel_m2 * static_cast<float>(from[x]);
      }
    }
  }

  void sample_surface(double z_m, std::span<float> squared_m2) const override {
    const std::size_t from = box_.index(0, 0, layer(z_m) - bounds_.low.z);
    std::copy_n(
        surface_m2_.begin() + static_cast<std::ptrdiff_t>(from), grid_.cells(), squared_m2.begin());
  }

  /// @return false if the fields would be too large.
  bool add_fields(const SemanticVolume& volume, SurfaceReach surface) {
    box_ = bounds_.box();
    if (box_.size() > kMaxFieldCells) return false;
    const auto truncation_m = static_cast<float>(shape_.truncation_m);
    surface_m2_.assign(box_.size(), truncation_m * truncation_m);
    for (const VoxelIndex& index : volume.block_indices()) add_block(index, *volume.block(index));
    if (surface == SurfaceReach::kEverywhere) extend_surface();
    std::size_t cells = box_.size();
    for (ClassBox& of : boxes_) {
      if (of.voxels.empty()) continue;
      of.bounds = of.bounds.grown_within(reach_, bounds_);
      cells += of.bounds.box().size();
    }
    if (cells > kMaxFieldCells) return false;
    for (ClassBox& of : boxes_) {
      if (!of.voxels.empty()) transform(of);
    }
    return true;
  }

 private:
  static constexpr int kSide = VoxelBlock::kSide;

  int layer(double z_m) const {
    const double z = std::floor(z_m / shape_.voxel_m);
    return static_cast<int>(std::clamp<double>(z, bounds_.low.z, bounds_.high.z - 1));
  }
  std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y - bounds_.low.y) * static_cast<std::size_t>(grid_.columns) +
           static_cast<std::size_t>(x - bounds_.low.x);
  }

  void add_block(const VoxelIndex& index, const VoxelBlock& block) {
    for (std::size_t i = 0; i < VoxelBlock::kVoxels; ++i) {
      const VoxelIndex at = SemanticVolume::voxel_of(index, i);
      if (block.weight[i] > 0.0F) {
        surface_m2_[box_.index(at.x - bounds_.low.x, at.y - bounds_.low.y, at.z - bounds_.low.z)] =
            block.sdf_m[i] * block.sdf_m[i];
      }
      const ClassId label = block.most_likely_class(i);
      if (label == kNoHit) continue;
      boxes_[label].voxels.push_back(at);
      boxes_[label].bounds.include(at, {at.x + 1, at.y + 1, at.z + 1});
    }
  }

  /// Where the stored distances end.
  void extend_surface() {
    const auto voxel_m2 = static_cast<float>(shape_.voxel_m * shape_.voxel_m);
    std::vector<std::uint8_t> passed(surface_m2_.size());
    // Of two neighbours on both sides of a surface one is within half a voxel of it.
    std::ranges::transform(surface_m2_, passed.begin(), [voxel_m2](float squared_m2) {
      return static_cast<std::uint8_t>(squared_m2 <= voxel_m2 / 4.0F);
    });
    const auto truncation_m = static_cast<float>(shape_.truncation_m);
    const float told_m2 = 0.98F * truncation_m * truncation_m;
    const std::vector<float> squared = squared_distances(passed, box_);
    for (std::size_t i = 0; i < squared.size(); ++i) {
      if (surface_m2_[i] >= told_m2) {
        surface_m2_[i] = std::max(surface_m2_[i], voxel_m2 * squared[i]);
      }
    }
  }

  void transform(ClassBox& of) const {
    const Box box = of.bounds.box();
    std::vector<std::uint8_t> marked(box.size());
    for (const VoxelIndex& at : std::exchange(of.voxels, {})) {
      marked[box.index(at.x - of.bounds.low.x, at.y - of.bounds.low.y, at.z - of.bounds.low.z)] = 1;
    }
    const std::vector<float> squared = squared_distances(marked, box);
    const auto farthest = static_cast<float>(reach_ * reach_);
    of.squared.resize(squared.size());
    std::ranges::transform(squared, of.squared.begin(), [farthest](float d2) {
      return d2 <= farthest ? static_cast<std::uint16_t>(d2) : kOutOfReach;
    });
  }

  ClassTable classes_;
  VolumeShape shape_;
  double ground_height_m_ = 0.0;
  int reach_ = 0;
  VoxelBounds bounds_;
  Box box_;
  LayerGrid grid_;
  std::vector<float> surface_m2_;
  std::vector<ClassBox> boxes_;  // by class id
};

}  // namespace

Result<std::unique_ptr<DistanceField>> distances_of_volume(const SemanticVolume& volume,
                                                           double ground_height_m,
                                                           SurfaceReach surface,
                                                           double reach_m,
                                                           double margin_m) {
  if (volume.block_count() == 0) {
    return fail(ErrorCode::kInvalidArgument, "the volume is empty: nothing to be near to");
  }
  const double voxel_m = volume.shape().voxel_m;
  const double reach = std::ceil(reach_m / voxel_m - 1e-6);
  if (!(reach >= 1.0 && reach <= kMaxReach_voxels)) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("distances up to {} m: expected at most {} voxels of {} m",
                            reach_m,
                            kMaxReach_voxels,
                            voxel_m));
  }
  if (!(margin_m >= 0.0 && margin_m <= 100.0)) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{} m beyond the volume: expected 0 to 100", margin_m));
  }
  auto distances =
      std::make_unique<VolumeDistances>(volume,
                                        ground_height_m,
                                        static_cast<int>(reach),
                                        static_cast<int>(std::ceil(margin_m / voxel_m)));
  if (!distances->add_fields(volume, surface)) {
    return fail(ErrorCode::kResourceExhausted,
                fmt::format("distance fields of more than {} cells: fuse into larger voxels",
                            kMaxFieldCells));
  }
  return std::unique_ptr<DistanceField>(std::move(distances));
}

}  // namespace semview::field
