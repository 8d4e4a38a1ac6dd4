// SPDX-License-Identifier: Apache-2.0
#include "semview/protocol/view_wire.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "semview/protocol/envelope.hpp"
#include "semview/protocol/packed_runs.hpp"
#include "semview/v1/scores.pb.h"
#include "semview/view/view_profile.hpp"

namespace semview::protocol {
namespace {

/// Pixels a side of an image that a request may bring.
constexpr std::uint32_t kMaxImageSide = 16'384;

Status check_count(int count, int other, std::size_t limit, std::string_view field) {
  if (count != other) {
    return wrong_field(field, fmt::format("lists of unequal length ({} and {})", count, other));
  }
  if (count == 0) return wrong_field(field, "empty; expected at least one");
  if (static_cast<std::size_t>(count) > limit) {
    return fail(Error{ErrorCode::kResourceExhausted,
                      fmt::format("{}: {} entries; at most {} in one request", field, count, limit),
                      std::string(field),
                      "split the request"});
  }
  return {};
}

/// The first entry that is not finite, if there is one.
Status check_finite(const google::protobuf::RepeatedField<double>& values,
                    std::string_view field,
                    std::string_view name) {
  const auto bad = std::find_if_not(
      values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  if (bad == values.end()) return {};
  return wrong_field(
      fmt::format("{}.{}", field, name),
      fmt::format("entry {} is {}; expected a finite number", bad - values.begin(), *bad));
}

}  // namespace

void to_wire(std::span<const Pose2> poses, v1::Poses* wire) {
  const int count = static_cast<int>(poses.size());
  wire->mutable_x_m()->Reserve(count);
  wire->mutable_y_m()->Reserve(count);
  wire->mutable_yaw_rad()->Reserve(count);
  for (const Pose2& pose : poses) {
    wire->add_x_m(pose.x_m);
    wire->add_y_m(pose.y_m);
    wire->add_yaw_rad(pose.yaw_rad);
  }
}

Result<std::vector<Pose2>> from_wire(const v1::Poses& wire,
                                     std::size_t limit,
                                     std::string_view field) {
  SEMVIEW_TRY_STATUS(check_count(wire.x_m_size(), wire.y_m_size(), limit, field));
  SEMVIEW_TRY_STATUS(check_count(wire.x_m_size(), wire.yaw_rad_size(), limit, field));
  SEMVIEW_TRY_STATUS(check_finite(wire.x_m(), field, "x_m"));
  SEMVIEW_TRY_STATUS(check_finite(wire.y_m(), field, "y_m"));
  SEMVIEW_TRY_STATUS(check_finite(wire.yaw_rad(), field, "yaw_rad"));
  std::vector<Pose2> poses(static_cast<std::size_t>(wire.x_m_size()));
  for (int i = 0; i < wire.x_m_size(); ++i) {
    const Pose2 pose{wire.x_m(i), wire.y_m(i), wire.yaw_rad(i)};
    if (std::abs(pose.x_m) > PoseGrid::kMaxCoordinate_m ||
        std::abs(pose.y_m) > PoseGrid::kMaxCoordinate_m) {
      return wrong_field(
          fmt::format(
              "{}.{}", field, std::abs(pose.x_m) > PoseGrid::kMaxCoordinate_m ? "x_m" : "y_m"),
          fmt::format("entry {} is beyond {:g} m from the origin", i, PoseGrid::kMaxCoordinate_m));
    }
    poses[static_cast<std::size_t>(i)] = pose;
  }
  return poses;
}

void to_wire(std::span<const CellIndex> cells, v1::Cells* wire) {
  for (const CellIndex& cell : cells) {
    wire->add_ix(cell.ix);
    wire->add_iy(cell.iy);
  }
}

Result<std::vector<CellIndex>> from_wire(const v1::Cells& wire,
                                         std::size_t limit,
                                         std::string_view field) {
  SEMVIEW_TRY_STATUS(check_count(wire.ix_size(), wire.iy_size(), limit, field));
  constexpr auto kMaxIndex =
      static_cast<std::int32_t>(PoseGrid::kMaxCoordinate_m / PoseGrid::kCellSize_m) - 1;
  std::vector<CellIndex> cells;
  cells.reserve(static_cast<std::size_t>(wire.ix_size()));
  for (int i = 0; i < wire.ix_size(); ++i) {
    for (const std::int32_t index : {wire.ix(i), wire.iy(i)}) {
      if (index < -kMaxIndex || index > kMaxIndex) {
        return wrong_field(
            field, fmt::format("entry {} is cell {}; expected at most {}", i, index, kMaxIndex));
      }
    }
    cells.push_back({wire.ix(i), wire.iy(i)});
  }
  return cells;
}

Result<MapAffine> from_wire(const v1::Affine& wire, std::string_view field) {
  if (wire.a() == 0.0 && wire.b() == 0.0 && wire.k() == 0.0) return MapAffine{};
  const MapAffine affine{wire.a(), wire.b(), wire.k()};
  // Written so that NaN fails.
  if (!(affine.a >= 0.2 && affine.a <= 5.0 && affine.b >= 0.2 && affine.b <= 5.0)) {
    return wrong_field(field, fmt::format("a {:g}, b {:g}; expected 0.2 to 5", affine.a, affine.b));
  }
  if (!(std::abs(affine.k) <= 2.0)) {
    return wrong_field(field, fmt::format("k {:g}; expected -2 to 2", affine.k));
  }
  return affine;
}

template <typename Intrinsics>
Result<PinholeCamera> camera_from_wire(const Intrinsics& wire, std::string_view field) {
  const auto wrong = [field](std::string_view name, std::string message) {
    return wrong_field(fmt::format("{}.{}", field, name), std::move(message));
  };
  for (const auto& [name, pixels] :
       {std::pair("columns", wire.columns()), std::pair("rows", wire.rows())}) {
    if (pixels == 0 || pixels > kMaxPinholeSide_px) {
      return wrong(name, fmt::format("{}; expected 1 to {}", pixels, kMaxPinholeSide_px));
    }
  }
  // Written so that NaN fails.
  for (const auto& [name, length_px] :
       {std::pair("fx_px", wire.fx_px()), std::pair("fy_px", wire.fy_px())}) {
    if (!(length_px >= kMinFocalLength_px && length_px <= kMaxFocalLength_px)) {
      return wrong(name,
                   fmt::format("focal length {:g} px; expected {:g} to {:g}",
                               length_px,
                               kMinFocalLength_px,
                               kMaxFocalLength_px));
    }
  }
  for (const auto& [name, point_px] :
       {std::pair("cx_px", wire.cx_px()), std::pair("cy_px", wire.cy_px())}) {
    if (!(std::abs(point_px) <= kMaxPrincipalPoint_px)) {
      return wrong(name,
                   fmt::format("principal point {:g} px; expected {:g} to {:g}",
                               point_px,
                               -kMaxPrincipalPoint_px,
                               kMaxPrincipalPoint_px));
    }
  }
  return PinholeCamera{static_cast<int>(wire.columns()),
                       static_cast<int>(wire.rows()),
                       wire.fx_px(),
                       wire.fy_px(),
                       wire.cx_px(),
                       wire.cy_px()};
}

template Result<PinholeCamera> camera_from_wire(const v1::ExactPinholes&, std::string_view);
template Result<PinholeCamera> camera_from_wire(const v1::DepthImage&, std::string_view);

v1::RunPanorama to_wire(const ColumnView& view) {
  v1::RunPanorama wire;
  wire.mutable_runs_in_column()->Reserve(view.columns());
  for (int c = 0; c < view.columns(); ++c) {
    wire.add_runs_in_column(static_cast<std::uint32_t>(view.column(c).size()));
  }
  wire.mutable_end_rows()->Reserve(static_cast<int>(view.runs().size()));
  wire.mutable_labels()->reserve(view.runs().size());
  for (const Run& run : view.runs()) {
    wire.add_end_rows(run.end_row);
    wire.mutable_labels()->push_back(static_cast<char>(run.label));
  }
  wire.set_planes(planes_to_bytes(view.planes()));
  return wire;
}

Result<ColumnView> from_wire(const v1::RunPanorama& wire, int rows, int columns) {
  if (!wire.packed().empty()) return unpack_runs(wire.packed(), rows, columns, wire.planes());
  const auto runs_count = static_cast<std::size_t>(wire.end_rows_size());
  if (wire.runs_in_column_size() != columns || wire.labels().size() != runs_count) {
    return fail(ErrorCode::kDataLoss,
                fmt::format("view: {} columns, {} runs, {} labels; expected {} columns and a label "
                            "a run",
                            wire.runs_in_column_size(),
                            runs_count,
                            wire.labels().size(),
                            columns));
  }
  std::vector<std::uint32_t> first_run{0};
  first_run.reserve(static_cast<std::size_t>(columns) + 1);
  std::uint64_t next = 0;
  for (const std::uint32_t count : wire.runs_in_column()) {
    next += count;
    if (next > runs_count) return fail(ErrorCode::kDataLoss, "view: more runs than sent");
    first_run.push_back(static_cast<std::uint32_t>(next));
  }
  std::vector<Run> runs;
  runs.reserve(runs_count);
  for (std::size_t i = 0; i < runs_count; ++i) {
    const std::uint32_t end_row = wire.end_rows(static_cast<int>(i));
    if (end_row > std::numeric_limits<std::uint16_t>::max()) {
      return fail(ErrorCode::kDataLoss, fmt::format("view: run {} ends at row {}", i, end_row));
    }
    runs.push_back({static_cast<std::uint16_t>(end_row), static_cast<ClassId>(wire.labels()[i])});
  }
  SEMVIEW_TRY(std::vector<RunPlane> planes, planes_from_bytes(wire.planes(), runs_count));
  return ColumnView::from_runs(rows, std::move(first_run), std::move(runs), std::move(planes));
}

v1::ViewOrigins to_wire(const ViewOrigins& origins) {
  v1::ViewOrigins wire;
  wire.set_memory(origins.memory);
  wire.set_disk(origins.disk);
  wire.set_cast(origins.cast);
  return wire;
}

ViewOrigins from_wire(const v1::ViewOrigins& wire) {
  return {wire.memory(), wire.disk(), wire.cast()};
}

Result<ViewBatch> from_wire(const v1::GetViewsReply& wire, std::size_t count) {
  if (static_cast<std::size_t>(wire.views_size()) != count ||
      wire.columns() > kMaxPanoramaColumns || wire.rows() > kMaxPanoramaRows) {
    return fail(ErrorCode::kDataLoss,
                fmt::format("{} views of {} × {}; expected {}",
                            wire.views_size(),
                            wire.rows(),
                            wire.columns(),
                            count));
  }
  ViewBatch batch;
  batch.views.reserve(count);
  for (const v1::View& view : wire.views()) {
    if (view.no_view()) {
      batch.views.push_back(nullptr);
      continue;
    }
    SEMVIEW_TRY(
        ColumnView runs,
        from_wire(view.runs(), static_cast<int>(wire.rows()), static_cast<int>(wire.columns())));
    batch.views.push_back(std::make_shared<const ColumnView>(std::move(runs)));
  }
  batch.origins = from_wire(wire.origins());
  return batch;
}

std::string to_bytes(std::span<const ClassId> labels) { return {labels.begin(), labels.end()}; }

Result<LabelImage> labels_from_bytes(std::string_view bytes,
                                     std::uint32_t rows,
                                     std::uint32_t columns,
                                     std::string_view field) {
  if (rows == 0 || columns == 0 || rows > kMaxImageSide || columns > kMaxImageSide) {
    return wrong_field(
        field,
        fmt::format("{} rows × {} columns; expected 1 to {} each", rows, columns, kMaxImageSide));
  }
  if (bytes.size() != std::size_t{rows} * columns) {
    return wrong_field(field,
                       fmt::format("{} bytes; expected {} rows × {} columns = {}",
                                   bytes.size(),
                                   rows,
                                   columns,
                                   std::size_t{rows} * columns));
  }
  LabelImage image(static_cast<int>(rows), static_cast<int>(columns));
  std::transform(bytes.begin(), bytes.end(), image.pixels().begin(), [](char byte) {
    return static_cast<ClassId>(byte);
  });
  return image;
}

}  // namespace semview::protocol
