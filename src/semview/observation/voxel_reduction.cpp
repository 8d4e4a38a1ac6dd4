// SPDX-License-Identifier: Apache-2.0
#include "semview/observation/voxel_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace semview::observation {
namespace {

constexpr double kFarthestMounting_m = 100.0;
/// Voxels are stored with signs, keys have none.
constexpr int kBias = 1 << 15;

/// Pixels of one voxel and class; equal keys may come several times.
struct Tally {
  std::uint64_t key = 0;
  std::uint32_t count = 0;
};

std::uint64_t key_of(ClassId label, int x, int y, int z) {
  const auto part = [](int i) { return static_cast<std::uint64_t>(i + kBias); };
  return static_cast<std::uint64_t>(label) << 48 | part(z) << 32 | part(y) << 16 | part(x);
}

ObservedVoxel voxel_of(const Tally& tally) {
  const auto part = [&tally](int shift) {
    return static_cast<std::int16_t>(static_cast<int>(tally.key >> shift & 0xFFFF) - kBias);
  };
  return {part(0), part(16), part(32), static_cast<ClassId>(tally.key >> 48), tally.count};
}

Status check(const DepthObservation& observation) {
  const PinholeCamera& camera = observation.camera;
  const auto matches = [&camera](const auto& image) {
    return image.rows() == camera.rows && image.columns() == camera.columns;
  };
  if (!matches(observation.depth_m) ||
      !(observation.labels.empty() || matches(observation.labels))) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("depth of {}x{}, labels of {}x{}: expected the camera's {}x{}",
                            observation.depth_m.columns(),
                            observation.depth_m.rows(),
                            observation.labels.columns(),
                            observation.labels.rows(),
                            camera.columns,
                            camera.rows));
  }
  const auto in = [](double value, double low, double high) {
    return value >= low && value <= high;
  };
  if (!in(camera.fx_px, kMinFocalLength_px, kMaxFocalLength_px) ||
      !in(camera.fy_px, kMinFocalLength_px, kMaxFocalLength_px) ||
      !in(std::abs(camera.cx_px), 0.0, kMaxPrincipalPoint_px) ||
      !in(std::abs(camera.cy_px), 0.0, kMaxPrincipalPoint_px)) {
    return fail(ErrorCode::kInvalidArgument, "intrinsics of the depth camera are out of range");
  }
  const Eigen::Matrix4d mounting = observation.base_from_camera.matrix();
  if (!mounting.allFinite() ||
      observation.base_from_camera.translation().norm() > kFarthestMounting_m) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("mounting of the camera: expected a pose within {} m of the base",
                            kFarthestMounting_m));
  }
  return {};
}

/// One tally a run of neighbouring pixels with the same voxel and class.
std::vector<Tally> tally_pixels(const DepthObservation& observation,
                                const VoxelReductionConfig& config) {
  const PinholeCamera& camera = observation.camera;
  const Eigen::Matrix3d turn = observation.base_from_camera.linear();
  const Eigen::Vector3d eye = observation.base_from_camera.translation();
  const int classes = observation.classes.size();
  std::vector<Tally> tallies;
  for (int row = 0; row < camera.rows; ++row) {
    for (int column = 0; column < camera.columns; ++column) {
      const double depth_m = static_cast<double>(observation.depth_m.at(row, column));
      if (!(depth_m >= config.min_depth_m && depth_m <= config.max_depth_m)) continue;
      const Eigen::Vector3d point_base = turn * (depth_m * camera.direction(row, column)) + eye;
      const Eigen::Vector3d place = point_base / config.voxel_m;
      // A lens of extreme width sees points aside that no voxel can name.
      if (!(place.cwiseAbs().maxCoeff() < kBias - 1)) continue;
      ClassId label = observation.labels.empty() ? kUnknown : observation.labels.at(row, column);
      if (label == kNoHit || label > classes) label = kUnknown;
      const std::uint64_t key = key_of(label,
                                       static_cast<int>(std::floor(place.x())),
                                       static_cast<int>(std::floor(place.y())),
                                       static_cast<int>(std::floor(place.z())));
      if (!tallies.empty() && tallies.back().key == key) {
        ++tallies.back().count;
      } else {
        tallies.push_back({key, 1});
      }
    }
  }
  return tallies;
}

}  // namespace

Status validate(const VoxelReductionConfig& config) {
  const auto refuse = [](const char* field, std::string message) {
    return fail(Error{ErrorCode::kInvalidArgument, std::move(message), field});
  };
  if (!(config.voxel_m >= 0.01 && config.voxel_m <= 1.0)) {
    return refuse("voxel", fmt::format("voxel of {} m: expected 0.01 to 1", config.voxel_m));
  }
  if (!(config.min_depth_m > 0.0 && config.min_depth_m < config.max_depth_m &&
        config.max_depth_m <= kFarthestMounting_m)) {
    return refuse("max_depth",
                  fmt::format("depths from {} to {} m: expected 0 < from < to <= {}",
                              config.min_depth_m,
                              config.max_depth_m,
                              kFarthestMounting_m));
  }
  return {};
}

Result<VoxelList> reduce(const DepthObservation& observation, const VoxelReductionConfig& config) {
  SEMVIEW_TRY_STATUS(validate(config));
  SEMVIEW_TRY_STATUS(check(observation));
  std::vector<Tally> tallies = tally_pixels(observation, config);
  if (tallies.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("no pixel of the depth image is between {} and {} m",
                            config.min_depth_m,
                            config.max_depth_m));
  }
  std::ranges::sort(tallies, {}, &Tally::key);
  VoxelList list{observation.classes, config.voxel_m, {}, observation.stamp_s};
  for (std::size_t i = 0; i < tallies.size();) {
    Tally sum = tallies[i];
    for (++i; i < tallies.size() && tallies[i].key == sum.key; ++i) sum.count += tallies[i].count;
    list.voxels.push_back(voxel_of(sum));
  }
  return list;
}

}  // namespace semview::observation
