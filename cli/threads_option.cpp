// SPDX-License-Identifier: Apache-2.0
#include "threads_option.hpp"

#include <CLI/CLI.hpp>

namespace semview::cli {
namespace {

constexpr int kMostThreads = 1024;

}  // namespace

void add_threads_option(CLI::App& verb, std::size_t& threads) {
  verb.add_option("--threads", threads, "Threads; 0: one a core; results do not change")
      ->check(CLI::Range(0, kMostThreads))
      ->capture_default_str();
}

}  // namespace semview::cli
