// SPDX-License-Identifier: Apache-2.0
/// Fetches the views of many cells a chunk at a time and hands each to a function in parallel.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "semview/core/result.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/similarity/prepared_observation.hpp"
#include "semview/view/view_source.hpp"

namespace semview::similarity {

/// Calls `visit(i, view)` once for each cell, `view` null where it has none. Calls come from
/// several threads in no defined order. Only some thousand views are held at a time, whatever the
/// count.
///
/// @param progress  Called from this thread after each chunk with the number of cells done; false
///        ends the sweep with kCancelled. May be empty.
/// @errors kCancelled; kInternal: a view that does not fit `observation`, or as many views as cells
/// did not come; what `views` fails with.
Result<ViewOrigins> sweep_views(
    const PreparedObservation& observation,
    ViewSource& views,
    std::span<const CellIndex> cells,
    ThreadPool& pool,
    const std::function<void(std::size_t i, const ColumnView* view)>& visit,
    const std::function<bool(std::size_t done)>& progress = {});

}  // namespace semview::similarity
