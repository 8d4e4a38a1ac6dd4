// SPDX-License-Identifier: Apache-2.0
/// What `semview localize` has to say at its end.
#pragma once

#include <optional>

#include "client/robot/localizer.hpp"
#include "client/robot/run_log_player.hpp"
#include "localize_options.hpp"
#include "localize_scorer.hpp"

namespace semview::cli {

/// As text or, with `--json`, as JSON, on standard output. `drive` has a frame at least.
void print_localize_summary(const LocalizeOptions& options,
                            const Scorer& scorer,
                            const std::optional<robot::DenseStart>& start,
                            const robot::Drive& drive);

}  // namespace semview::cli
