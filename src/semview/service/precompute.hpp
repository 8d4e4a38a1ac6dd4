// SPDX-License-Identifier: Apache-2.0
/// Casting and storing the views of a map ahead of time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "semview/core/clock.hpp"
#include "semview/core/result.hpp"
#include "semview/geometry/pose_grid.hpp"

namespace semview::service {

class Site;

/// Which cells: all free ones, or those of a part. At most one of the two may be set.
struct PrecomputeRegion {
  std::optional<std::array<double, 4>> rectangle_m = {};  ///< x0, y0, x1, y1: cell centres inside
  std::optional<std::array<double, 2>> reachable_from_m = {};  ///< x, y of a free place
};

struct PrecomputePlan {
  std::vector<CellIndex> cells;  ///< distinct view cells, row by row
  std::size_t free_cells = 0;    ///< that these views serve
};

/// The cells whose views a region needs: free cells, each by the rule of the nearest eye.
/// @errors kInvalidArgument: empty or unordered rectangle, both parts set, a place that is not
/// free; kNotFound: no free cell.
Result<PrecomputePlan> plan_precompute(const Site& site, const PrecomputeRegion& region);

struct PrecomputeProgress {
  std::size_t cells = 0;    ///< of the plan
  std::size_t found = 0;    ///< stored by an earlier run, and sound
  std::size_t cast = 0;     ///< by this run
  std::uint64_t bytes = 0;  ///< of the records stored by this run
  double elapsed_s = 0.0;
  double views_per_s = 0.0;  ///< cast by this run
  double remaining_s = 0.0;  ///< estimate; 0 until something was cast
};

enum class PrecomputeEnd { kComplete, kStopped };

struct PrecomputeResult {
  PrecomputeProgress progress;
  PrecomputeEnd end = PrecomputeEnd::kComplete;
};

/// Casts and stores what the cache directory does not hold yet, row by row. The records are the
/// same for any thread count and any number of interruptions; `stop` is obeyed within a second.
/// `progress` (may be empty) is called after every commit, in the calling thread.
/// @errors kFailedPrecondition: no cache directory; kResourceExhausted: storing has stopped (full
/// disk, `--cache-limit`).
Result<PrecomputeResult> run_precompute(
    const Site& site,
    const PrecomputePlan& plan,
    std::stop_token stop,
    const std::function<void(const PrecomputeProgress&)>& progress,
    const Clock& clock = steady_clock());

struct PrecomputeEstimate {
  std::size_t cells = 0;
  std::size_t found = 0;    ///< stored already
  std::size_t sampled = 0;  ///< cast for the estimate, none stored
  double seconds = 0.0;     ///< for what is missing
  std::uint64_t bytes = 0;  ///< for what is missing, on disk
};

/// Casts a sample of the missing cells and says what the rest would take; stores nothing.
Result<PrecomputeEstimate> estimate_precompute(const Site& site,
                                               const PrecomputePlan& plan,
                                               const Clock& clock = steady_clock());

}  // namespace semview::service
