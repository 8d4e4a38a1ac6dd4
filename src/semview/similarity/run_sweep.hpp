// SPDX-License-Identifier: Apache-2.0
/// The inner loops of scoring: the runs of a view against the prefix sums of an observation.
#pragma once

#include <cstdint>
#include <span>

#include "semview/geometry/pose_grid.hpp"
#include "semview/similarity/prefix_table.hpp"
#include "semview/view/column_view.hpp"

namespace semview::similarity {

/// The sum at one heading of the PoseGrid, in [0, 120): run by run, column by column.
/// `view` has the table's shape and classes.
std::int32_t sum_runs(const PrefixTable& table, const ColumnView& view, int heading);

/// The same at all headings at once, with the widest vector instructions that this machine has; the
/// numbers are the same with any.
void sweep_runs(const PrefixTable& table,
                const ColumnView& view,
                std::span<std::int32_t, PoseGrid::kHeadings> sums);

}  // namespace semview::similarity
