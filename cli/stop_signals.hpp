// SPDX-License-Identifier: Apache-2.0
/// Ctrl-C as a wish, for verbs that have something to put away first.
#pragma once

namespace semview::cli {

/// From now on the first Ctrl-C (or SIGTERM) asks; a second one kills.
void ask_to_stop_on_signals();

/// Has one asked?
bool stop_asked();

}  // namespace semview::cli
