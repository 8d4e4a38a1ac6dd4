// SPDX-License-Identifier: Apache-2.0
/// The verbs below `semview bench`, one a file.
#pragma once

namespace CLI {
class App;
}

namespace semview::cli {

void add_bench_load_verb(CLI::App& bench, int& exit_code);

}  // namespace semview::cli
