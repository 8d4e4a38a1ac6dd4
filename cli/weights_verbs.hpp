// SPDX-License-Identifier: Apache-2.0
/// The verbs under `semview weights` that have files of their own.
#pragma once

namespace CLI {
class App;
}

namespace semview::cli {

// Each adds its verb to `weights`; when it has run, `exit_code` holds the program's exit code.
void add_weights_learn(CLI::App& weights, int& exit_code);
void add_weights_show(CLI::App& weights, int& exit_code);

}  // namespace semview::cli
