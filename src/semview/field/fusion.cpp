// SPDX-License-Identifier: Apache-2.0
#include "semview/field/fusion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

#include <fmt/format.h>

namespace semview::field {
namespace {

using BlockIndex = SemanticVolume::BlockIndex;

constexpr std::size_t kRowsAtOnce = 16;
constexpr std::size_t kBlocksAtOnce = 64;

bool usable(float depth_m, const FusionConfig& config) {
  return std::isfinite(depth_m) && depth_m >= config.min_depth_m && depth_m <= config.max_depth_m;
}

template <typename T>
bool has_size(const Image<T>& image, const PinholeCamera& camera) {
  return image.rows() == camera.rows && image.columns() == camera.columns;
}

Status check(const DepthFrame& frame) {
  const auto wrong = [&](const char* what, int columns, int rows) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{} of {} x {} pixels, the camera has {} x {}",
                            what,
                            columns,
                            rows,
                            frame.camera.columns,
                            frame.camera.rows));
  };
  if (!has_size(frame.depth_m, frame.camera)) {
    return wrong("depth", frame.depth_m.columns(), frame.depth_m.rows());
  }
  if (!frame.labels.empty() && !has_size(frame.labels, frame.camera)) {
    return wrong("labels", frame.labels.columns(), frame.labels.rows());
  }
  if (!frame.colour.empty() && !has_size(frame.colour, frame.camera)) {
    return wrong("colour", frame.colour.columns(), frame.colour.rows());
  }
  if (!frame.map_from_camera.matrix().allFinite()) {
    return fail(ErrorCode::kInvalidArgument, "the pose is not finite");
  }
  return {};
}

/// Adds the blocks within the truncation distance of a row's surfaces, some of them more than once.
/// @return how many pixels of the row have a depth
std::size_t add_blocks_near_row(const DepthFrame& frame,
                                int row,
                                const FusionConfig& config,
                                const SemanticVolume& volume,
                                std::vector<BlockIndex>& near) {
  const double reach_m = volume.shape().truncation_m;
  // Half a block: of what a ray crosses, only corners can be passed over.
  const double step_m = volume.shape().voxel_m * VoxelBlock::kSide / 2.0;
  const int steps = static_cast<int>(std::ceil(2.0 * reach_m / step_m));
  // A pixel's blocks are mostly its neighbour's: with these most of them need not be sorted.
  constexpr int kNowhere = std::numeric_limits<int>::max();
  std::vector<BlockIndex> last(static_cast<std::size_t>(steps) + 1, {kNowhere, 0, 0});
  std::size_t pixels = 0;
  for (int column = 0; column < frame.camera.columns; ++column) {
    const float depth_m = frame.depth_m.at(row, column);
    if (!usable(depth_m, config)) continue;
    ++pixels;
    const Eigen::Vector3d along =
        frame.map_from_camera.linear() * frame.camera.direction(row, column);
    for (std::size_t s = 0; s < last.size(); ++s) {
      const double z_m = depth_m - reach_m + 2.0 * reach_m * static_cast<double>(s) / steps;
      const BlockIndex block = SemanticVolume::block_of(
          volume.voxel_at(frame.map_from_camera.translation() + z_m * along));
      if (block == last[s]) continue;
      last[s] = block;
      near.push_back(block);
    }
  }
  return pixels;
}

void sort_out(std::vector<BlockIndex>& blocks) {
  std::ranges::sort(blocks);
  blocks.erase(std::ranges::unique(blocks).begin(), blocks.end());
}

Result<std::size_t> add_blocks(const DepthFrame& frame,
                               const FusionConfig& config,
                               ThreadPool& pool,
                               SemanticVolume& volume) {
  std::mutex mutex;
  std::vector<BlockIndex> wanted;
  std::size_t pixels = 0;
  const auto rows = static_cast<std::size_t>(frame.camera.rows);
  pool.parallel_for(rows, kRowsAtOnce, [&](std::size_t begin, std::size_t end) {
    std::vector<BlockIndex> near;
    std::size_t used = 0;
    for (std::size_t row = begin; row < end; ++row) {
      used += add_blocks_near_row(frame, static_cast<int>(row), config, volume, near);
    }
    sort_out(near);
    const std::lock_guard lock(mutex);
    wanted.insert(wanted.end(), near.begin(), near.end());
    pixels += used;
  });
  if (pixels == 0) {
    return fail(
        ErrorCode::kInvalidArgument,
        fmt::format("no depth between {:g} and {:g} m", config.min_depth_m, config.max_depth_m));
  }
  sort_out(wanted);
  const auto is_new = [&](const BlockIndex& index) { return volume.block(index) == nullptr; };
  const auto added = static_cast<std::size_t>(std::ranges::count_if(wanted, is_new));
  if (volume.block_count() + added > kMaxBlocks) {
    return fail(ErrorCode::kResourceExhausted,
                fmt::format("more than {} blocks of {}³ voxels of {:g} m: take larger voxels",
                            kMaxBlocks,
                            VoxelBlock::kSide,
                            volume.shape().voxel_m));
  }
  for (const BlockIndex& index : wanted) volume.add_block(index);
  return pixels;
}

/// Takes one frame into the voxels of one block.
class BlockUpdate {
 public:
  BlockUpdate(const DepthFrame& frame, const FusionConfig& config, const SemanticVolume& volume)
      : frame_(frame),
        config_(config),
        volume_(volume),
        camera_from_map_(frame.map_from_camera.inverse()) {}

  /// False if no voxel of the block can be seen.
  bool may_see(const BlockIndex& index) const {
    const double side_m = volume_.shape().voxel_m * VoxelBlock::kSide;
    const Eigen::Vector3d centre =
        camera_from_map_ *
        Eigen::Vector3d(side_m * Eigen::Vector3d(index.x + 0.5, index.y + 0.5, index.z + 0.5));
    const double radius_m = side_m * std::sqrt(3.0) / 2.0;
    return centre.z() > -radius_m &&
           centre.z() < config_.max_depth_m + volume_.shape().truncation_m + radius_m;
  }

  /// True if a voxel changed.
  bool run(const BlockIndex& index, VoxelBlock& block) const {
    bool changed = false;
    const Eigen::Vector3d first =
        camera_from_map_ * volume_.centre(SemanticVolume::voxel_of(index, 0));
    const Eigen::Matrix3d steps = volume_.shape().voxel_m * camera_from_map_.linear();
    for (std::size_t place = 0; place < VoxelBlock::kVoxels; ++place) {
      const VoxelIndex within = SemanticVolume::voxel_of({}, place);
      const Eigen::Vector3d point =
          first + within.x * steps.col(0) + within.y * steps.col(1) + within.z * steps.col(2);
      if (point.z() <= 0.0) continue;
      const double u = frame_.camera.fx_px * point.x() / point.z() + frame_.camera.cx_px;
      const double v = frame_.camera.fy_px * point.y() / point.z() + frame_.camera.cy_px;
      if (!(u >= 0.0 && u < frame_.camera.columns && v >= 0.0 && v < frame_.camera.rows)) continue;
      changed = take(block, place, static_cast<int>(v), static_cast<int>(u), point.z()) || changed;
    }
    return changed;
  }

 private:
  bool take(VoxelBlock& block, std::size_t place, int row, int column, double z_m) const {
    const float depth_m = frame_.depth_m.at(row, column);
    if (!usable(depth_m, config_)) return false;
    const double truncation_m = volume_.shape().truncation_m;
    const double distance_m = depth_m - z_m;
    if (distance_m < -truncation_m) return false;  // hidden behind the surface
    const auto sdf_m = static_cast<float>(std::min(distance_m, truncation_m));
    float& weight = block.weight[place];
    block.sdf_m[place] = (block.sdf_m[place] * weight + sdf_m) / (weight + 1.0F);
    weight += 1.0F;
    if (std::abs(distance_m) <= volume_.shape().voxel_m) {
      if (!frame_.labels.empty()) count(block, place, frame_.labels.at(row, column));
      if (!frame_.colour.empty()) blend(block, place, frame_.colour.at(row, column));
    }
    return true;
  }

  void count(VoxelBlock& block, std::size_t place, ClassId label) const {
    if (label != kNoHit && label <= volume_.classes().size()) block.count(place, label, 1);
  }

  static void blend(VoxelBlock& block, std::size_t place, const Rgb& colour) {
    if (block.colour.empty()) {
      block.colour.assign(VoxelBlock::kVoxels, Eigen::Vector3f::Zero());
      block.colour_weight.assign(VoxelBlock::kVoxels, 0.0F);
    }
    float& weight = block.colour_weight[place];
    const Eigen::Vector3f seen(colour.r, colour.g, colour.b);
    block.colour[place] = (block.colour[place] * weight + seen) / (weight + 1.0F);
    weight += 1.0F;
  }

  const DepthFrame& frame_;
  const FusionConfig& config_;
  const SemanticVolume& volume_;
  const Eigen::Isometry3d camera_from_map_;
};

}  // namespace

Status validate(const FusionConfig& config) {
  if (!(config.min_depth_m >= 0.0 && config.min_depth_m < config.max_depth_m &&
        config.max_depth_m <= 100.0)) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("depths from {} to {} m: expected 0 <= first < second <= 100",
                                  config.min_depth_m,
                                  config.max_depth_m),
                      "max_depth"});
  }
  return {};
}

Result<FusedFrame> fuse(const DepthFrame& frame,
                        const FusionConfig& config,
                        ThreadPool& pool,
                        SemanticVolume& volume) {
  SEMVIEW_TRY_STATUS(check(frame));
  FusedFrame fused;
  SEMVIEW_TRY(fused.depth_pixels, add_blocks(frame, config, pool, volume));
  const BlockUpdate update(frame, config, volume);
  std::vector<BlockIndex> seen;
  for (const BlockIndex& index : volume.block_indices()) {
    if (update.may_see(index)) seen.push_back(index);
  }
  std::vector<std::uint8_t> changed(seen.size());
  pool.parallel_for(seen.size(), kBlocksAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      changed[i] = update.run(seen[i], *volume.block(seen[i])) ? 1 : 0;
    }
  });
  fused.blocks = static_cast<std::size_t>(std::ranges::count(changed, 1));
  return fused;
}

}  // namespace semview::field
