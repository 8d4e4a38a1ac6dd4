// SPDX-License-Identifier: Apache-2.0
/// What a cycle costs without a server: the ceiling of what one can hold.
#pragma once

#include "client/load/load_work.hpp"
#include "semview/core/result.hpp"
#include "semview/view/view_source.hpp"

namespace semview::client {

struct KernelTime {
  double prepare_ms = 0.0;  ///< an observation's tables
  double score_ms = 0.0;    ///< the kernel on the cells of one request

  double cycle_ms() const { return prepare_ms + score_ms; }
  /// Robots that `cores` could serve if nothing but this were to do.
  double robots(std::size_t cores, double rate_hz) const;
};

/// Prepares the work's observations and calls the kernel for each cell of a request, in this
/// thread; the best of some rounds. Views are fetched and poses grouped by cell before; the weight
/// matrix is given, not read from its text.
/// @errors those of `views` and PreparedObservation::build
Result<KernelTime> kernel_time(const LoadWork& work, ViewSource& views);

}  // namespace semview::client
