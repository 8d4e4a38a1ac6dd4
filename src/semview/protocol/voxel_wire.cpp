// SPDX-License-Identifier: Apache-2.0
#include "semview/protocol/voxel_wire.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "semview/protocol/envelope.hpp"
#include "semview/protocol/view_wire.hpp"

namespace semview::protocol {
namespace {

constexpr int kMountingNumbers = 12;  // 3 × 4

auto order_of(const ObservedVoxel& voxel) {
  return std::tuple(voxel.label, voxel.z, voxel.y, voxel.x);
}

/// @errors kInvalidArgument: more than 16 bits, an id of no class, or no pixels.
Result<ObservedVoxel> voxel_at(const v1::VoxelList& wire, int i, int classes) {
  for (const auto& [name, place] :
       {std::pair("x", wire.x(i)), std::pair("y", wire.y(i)), std::pair("z", wire.z(i))}) {
    if (place < std::numeric_limits<std::int16_t>::min() ||
        place > std::numeric_limits<std::int16_t>::max()) {
      return wrong_field(fmt::format("voxels.{}", name),
                         fmt::format("entry {} is {}; expected 16 bits", i, place));
    }
  }
  const auto label = static_cast<ClassId>(wire.labels()[static_cast<std::size_t>(i)]);
  if (label == kNoHit || (label > classes && label != kUnknown)) {
    return wrong_field(
        "voxels.labels",
        fmt::format("entry {} is {}; expected 1 to {}, or {}", i, label, classes, kUnknown));
  }
  const std::uint32_t count = wire.counts(i);
  if (count == 0 || count > kMaxVoxelPixels) {
    return wrong_field("voxels.counts",
                       fmt::format("entry {} is {}; expected 1 to {}", i, count, kMaxVoxelPixels));
  }
  return ObservedVoxel{static_cast<std::int16_t>(wire.x(i)),
                       static_cast<std::int16_t>(wire.y(i)),
                       static_cast<std::int16_t>(wire.z(i)),
                       label,
                       count};
}

std::uint16_t millimetres(float depth_m) {
  const double rounded = std::round(static_cast<double>(depth_m) * 1000.0);
  // Written so that NaN fails.
  return rounded >= 0.0 && rounded <= 65535.0 ? static_cast<std::uint16_t>(rounded)
                                              : std::uint16_t{0};
}

Result<Image<float>> depth_from_bytes(const std::string& bytes, const PinholeCamera& camera) {
  const std::size_t pixels =
      static_cast<std::size_t>(camera.rows) * static_cast<std::size_t>(camera.columns);
  if (bytes.size() != 2 * pixels) {
    return wrong_field("depth.depth_mm",
                       fmt::format("{} bytes; expected 2 × {} rows × {} columns = {}",
                                   bytes.size(),
                                   camera.rows,
                                   camera.columns,
                                   2 * pixels));
  }
  Image<float> depth_m(camera.rows, camera.columns);
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto byte = [&bytes](std::size_t at) { return static_cast<unsigned char>(bytes[at]); };
    // As the depth of run logs is read.
    depth_m.pixels()[i] = static_cast<float>(byte(2 * i) | byte(2 * i + 1) << 8U) / 1000.0F;
  }
  return depth_m;
}

Result<Eigen::Isometry3d> mounting_from_wire(const v1::DepthImage& wire) {
  constexpr std::string_view kField = "depth.base_from_camera";
  if (wire.base_from_camera_size() != kMountingNumbers) {
    return wrong_field(kField,
                       fmt::format("{} numbers; expected 3 × 4", wire.base_from_camera_size()));
  }
  Eigen::Isometry3d mounting = Eigen::Isometry3d::Identity();
  for (int i = 0; i < kMountingNumbers; ++i) {
    mounting.matrix()(i / 4, i % 4) = wire.base_from_camera(i);
  }
  const Eigen::Matrix3d turn = mounting.linear();
  const double off = (turn * turn.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  // Written so that NaN fails.
  if (!(off < 1e-6 && turn.determinant() > 0.0 &&
        std::isfinite(mounting.translation().squaredNorm()))) {
    return wrong_field(kField, "not a rotation and a translation");
  }
  return mounting;
}

}  // namespace

void to_wire(const VoxelList& list, v1::VoxelList* wire) {
  wire->set_voxel_m(list.voxel_m);
  for (const ObservedVoxel& voxel : list.voxels) {
    wire->add_x(voxel.x);
    wire->add_y(voxel.y);
    wire->add_z(voxel.z);
    wire->mutable_labels()->push_back(static_cast<char>(voxel.label));
    wire->add_counts(voxel.count);
  }
}

Result<VoxelList> from_wire(const v1::VoxelList& wire, const ClassTable& classes, double stamp_s) {
  // Written so that NaN fails.
  if (!(wire.voxel_m() >= 0.01 && wire.voxel_m() <= 1.0)) {
    return wrong_field("voxels.voxel_m", fmt::format("{:g} m; expected 0.01 to 1", wire.voxel_m()));
  }
  const int count = wire.x_size();
  if (count == 0 || wire.y_size() != count || wire.z_size() != count ||
      wire.labels().size() != static_cast<std::size_t>(count) || wire.counts_size() != count) {
    return wrong_field("voxels",
                       fmt::format("{} x, {} y, {} z, {} labels, {} counts; expected one each a "
                                   "voxel, and at least one",
                                   count,
                                   wire.y_size(),
                                   wire.z_size(),
                                   wire.labels().size(),
                                   wire.counts_size()));
  }
  VoxelList list{classes, wire.voxel_m(), {}, stamp_s};
  list.voxels.reserve(static_cast<std::size_t>(count));
  std::uint64_t pixels = 0;
  for (int i = 0; i < count; ++i) {
    SEMVIEW_TRY(const ObservedVoxel voxel, voxel_at(wire, i, classes.size()));
    if (!list.voxels.empty() && order_of(list.voxels.back()) >= order_of(voxel)) {
      return wrong_field(
          "voxels",
          fmt::format("entry {} is not after the one before; expected each once, by label, z, y, x",
                      i));
    }
    pixels += voxel.count;
    list.voxels.push_back(voxel);
  }
  if (pixels > kMaxVoxelPixels) {
    return wrong_field(
        "voxels.counts",
        fmt::format("{} pixels in all; expected at most {}", pixels, kMaxVoxelPixels));
  }
  return list;
}

void to_wire(const DepthObservation& seen, v1::DepthImage* wire) {
  wire->set_rows(static_cast<std::uint32_t>(seen.camera.rows));
  wire->set_columns(static_cast<std::uint32_t>(seen.camera.columns));
  std::string& bytes = *wire->mutable_depth_mm();
  for (const float depth_m : seen.depth_m.pixels()) {
    const std::uint16_t depth_mm = millimetres(depth_m);
    bytes.push_back(static_cast<char>(depth_mm & 0xFFU));
    bytes.push_back(static_cast<char>(depth_mm >> 8U));
  }
  wire->set_labels(to_bytes(seen.labels.pixels()));
  wire->set_fx_px(seen.camera.fx_px);
  wire->set_fy_px(seen.camera.fy_px);
  wire->set_cx_px(seen.camera.cx_px);
  wire->set_cy_px(seen.camera.cy_px);
  for (int i = 0; i < kMountingNumbers; ++i) {
    wire->add_base_from_camera(seen.base_from_camera.matrix()(i / 4, i % 4));
  }
}

Result<DepthObservation> from_wire(const v1::DepthImage& wire,
                                   const ClassTable& classes,
                                   double stamp_s) {
  DepthObservation seen;
  seen.classes = classes;
  seen.stamp_s = stamp_s;
  SEMVIEW_TRY(seen.camera, camera_from_wire(wire, "depth"));
  SEMVIEW_TRY(seen.depth_m, depth_from_bytes(wire.depth_mm(), seen.camera));
  if (!wire.labels().empty()) {
    SEMVIEW_TRY(seen.labels,
                labels_from_bytes(wire.labels(), wire.rows(), wire.columns(), "depth.labels"));
  }
  SEMVIEW_TRY(seen.base_from_camera, mounting_from_wire(wire));
  return seen;
}

}  // namespace semview::protocol
