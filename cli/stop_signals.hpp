// SPDX-License-Identifier: Apache-2.0
/// Ctrl-C as a wish, for verbs that have something to put away first, or to say at least.
#pragma once

#include <string>

namespace semview::cli {

/// From now on the first Ctrl-C (or SIGTERM) asks; a second one kills.
void ask_to_stop_on_signals();

/// Has one asked?
bool stop_asked();

/// From now on Ctrl-C (or SIGTERM) prints `semview: <line>` on standard error before it ends the
/// program: what of its work is kept.
void say_when_stopped(const std::string& line);

}  // namespace semview::cli
