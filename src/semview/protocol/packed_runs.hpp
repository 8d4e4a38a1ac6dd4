// SPDX-License-Identifier: Apache-2.0
/// The runs of a view as one string of bytes: docs/protocol.md#packed-runs.
#pragma once

#include <string>
#include <string_view>

#include "semview/core/result.hpp"
#include "semview/view/column_view.hpp"

namespace semview::protocol {

std::string pack_runs(const ColumnView& view);

/// The view packed in `bytes`, which may come from anybody.
/// @errors kDataLoss: not the runs of a view of `rows` × `columns`.
Result<ColumnView> unpack_runs(std::string_view bytes, int rows, int columns);

}  // namespace semview::protocol
