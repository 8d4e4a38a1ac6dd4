// SPDX-License-Identifier: Apache-2.0
/// Maps and jobs as messages.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/protocol/descriptions.hpp"
#include "semview/v1/jobs.pb.h"
#include "semview/v1/maps.pb.h"

namespace semview::protocol {

/// Cells that a map may have at most: 2 km × 2 km would be more.
inline constexpr std::size_t kMaxMapCells = 100'000'000;

v1::MapSummary to_wire(const MapSummary& summary);
/// @errors kDataLoss: the fingerprint has not 16 bytes.
Result<MapSummary> from_wire(const v1::MapSummary& wire);

std::string to_wire(const Fingerprint& fingerprint);

v1::ViewProfile to_wire(const ViewProfile& profile);
/// @errors those of `semview::validate`, `field` put before the field's name.
Result<ViewProfile> from_wire(const v1::ViewProfile& wire, std::string_view field);

/// `cells` row by row.
v1::CellRuns to_wire(std::span<const CellIndex> cells);
/// @errors kDataLoss: lists of unequal length, or more than `kMaxMapCells` cells.
Result<std::vector<CellIndex>> from_wire(const v1::CellRuns& wire);

v1::GetMapReply to_wire(const MapDescription& map);
/// @errors kDataLoss: a part that cannot be.
Result<MapDescription> from_wire(const v1::GetMapReply& wire);

v1::JobStatusReply to_wire(const JobProgress& progress);
/// @errors kDataLoss: a state that this version does not know.
Result<JobProgress> from_wire(const v1::JobStatusReply& wire);

}  // namespace semview::protocol
