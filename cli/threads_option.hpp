// SPDX-License-Identifier: Apache-2.0
/// How many threads a verb works with: --threads.
#pragma once

#include <cstddef>

namespace CLI {
class App;
}

namespace semview::cli {

/// Adds --threads, 0 to 1024: a system refuses more, and what it was asked for is seldom meant.
void add_threads_option(CLI::App& verb, std::size_t& threads);

}  // namespace semview::cli
