// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <exception>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "semview/core/version.hpp"
#include "verb.hpp"

int main(int argc, char** argv) {
  int exit_code = 0;
  // A limit on file sizes ends storing, as a full disk does, and not the program.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    CLI::App app{"semview: what would a camera see from here, in semantic labels?", "semview"};
    app.set_version_flag("--version", semview::kVersion);
    app.require_subcommand(1);
    semview::cli::add_map_verb(app, exit_code);
    semview::cli::add_simulate_verb(app, exit_code);
    semview::cli::add_fuse_verb(app, exit_code);
    semview::cli::add_precompute_verb(app, exit_code);
    semview::cli::add_cache_verb(app, exit_code);
    semview::cli::add_weights_verb(app, exit_code);
    semview::cli::add_view_verb(app, exit_code);
    semview::cli::add_evaluate_verb(app, exit_code);
    semview::cli::add_observe_verb(app, exit_code);
    semview::cli::add_score_verb(app, exit_code);
    semview::cli::add_heatmap_verb(app, exit_code);
    semview::cli::add_localize_verb(app, exit_code);
    semview::cli::add_locate_verb(app, exit_code);
    semview::cli::add_bench_verb(app, exit_code);
    semview::cli::check_whole_numbers(app);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      const int code = app.exit(error);
      return code == 0 ? 0 : semview::cli::kExitUsage;
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "semview: internal error: {}\n", error.what());
    return semview::cli::kExitFailed;
  }
  return exit_code;
}
