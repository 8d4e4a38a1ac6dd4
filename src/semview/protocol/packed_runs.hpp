// SPDX-License-Identifier: Apache-2.0
/// The runs of a view as one string of bytes: docs/protocol.md#packed-runs.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/view/column_view.hpp"

namespace semview::protocol {

std::string pack_runs(const ColumnView& view);
/// The planes of the runs that `pack_runs` lists; empty without ranges.
std::string pack_planes(const ColumnView& view);

/// The view packed in `bytes` and, if that is not empty, `planes`; they may come from anybody.
/// @errors kDataLoss: not the runs of a view of `rows` × `columns`, or not one plane a run.
Result<ColumnView> unpack_runs(std::string_view bytes,
                               int rows,
                               int columns,
                               std::string_view planes = {});

/// Two floats of 4 bytes, little endian, a plane.
std::string planes_to_bytes(std::span<const RunPlane> planes);
/// @errors kDataLoss: neither empty nor `count` planes.
Result<std::vector<RunPlane>> planes_from_bytes(std::string_view bytes, std::size_t count);

}  // namespace semview::protocol
