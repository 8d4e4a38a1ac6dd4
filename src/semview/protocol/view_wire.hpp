// SPDX-License-Identifier: Apache-2.0
/// Poses, cells and views as messages.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/affine.hpp"
#include "semview/geometry/pinhole_camera.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/v1/views.pb.h"
#include "semview/view/column_view.hpp"
#include "semview/view/view_source.hpp"

namespace semview::protocol {

void to_wire(std::span<const Pose2> poses, v1::Poses* wire);
/// @errors kInvalidArgument: lists of unequal length, none, more than `limit` poses (then
/// kResourceExhausted), or a number that is not finite; the field is named, `field` before it.
Result<std::vector<Pose2>> from_wire(const v1::Poses& wire,
                                     std::size_t limit,
                                     std::string_view field);

void to_wire(std::span<const CellIndex> cells, v1::Cells* wire);
/// @errors as for poses; kInvalidArgument: a cell beyond `PoseGrid::kMaxCoordinate_m`.
Result<std::vector<CellIndex>> from_wire(const v1::Cells& wire,
                                         std::size_t limit,
                                         std::string_view field);

/// All zero stands for the identity.
/// @errors kInvalidArgument: outside the ranges of `MapAffine`.
Result<MapAffine> from_wire(const v1::Affine& wire, std::string_view field);

/// The intrinsics of an `ExactPinholes` or a `DepthImage`.
/// @errors kInvalidArgument: an empty image, or numbers that are not finite or focal lengths that
/// are not positive.
template <typename Intrinsics>
Result<PinholeCamera> camera_from_wire(const Intrinsics& wire, std::string_view field);

v1::RunPanorama to_wire(const ColumnView& view);
/// The runs of a panorama of `rows` × `columns`, packed or as lists.
/// @errors kDataLoss: not the canonical runs of such a panorama.
Result<ColumnView> from_wire(const v1::RunPanorama& wire, int rows, int columns);

v1::ViewOrigins to_wire(const ViewOrigins& origins);
ViewOrigins from_wire(const v1::ViewOrigins& wire);

/// @errors kDataLoss: not exactly `count` panoramas as runs.
Result<ViewBatch> from_wire(const v1::GetViewsReply& wire, std::size_t count);

/// One byte a pixel, row by row.
std::string to_bytes(std::span<const ClassId> labels);
/// @errors kInvalidArgument: not rows × columns bytes, or an empty or oversize image; `field`
/// named.
Result<LabelImage> labels_from_bytes(std::string_view bytes,
                                     std::uint32_t rows,
                                     std::uint32_t columns,
                                     std::string_view field);

}  // namespace semview::protocol
