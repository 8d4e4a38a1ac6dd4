// SPDX-License-Identifier: Apache-2.0
/// Options of `semview localize` for what the papers do not do: maps drawn distorted, adaptive
/// numbers of particles, recovery.
#pragma once

#include "localize_options.hpp"

namespace semview::cli {

/// Declares the options; `options` must outlive the parse.
void add_belief_options(CLI::App& verb, LocalizeOptions& options);

/// What belongs together. @errors kInvalidArgument, with the option as the field.
Status check_belief_options(const CLI::App& verb, const LocalizeOptions& options);

/// Writes the options into `config`.
void apply_belief_options(const LocalizeOptions& options, robot::LocalizerConfig& config);

}  // namespace semview::cli
