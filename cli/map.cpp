// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include "verb.hpp"

namespace semview::cli {

void add_map_verb(CLI::App& app, int& exit_code) {
  static_cast<void>(exit_code);
  CLI::App* map = app.add_subcommand("map", "Check, look at and convert maps");
  map->require_subcommand(1);
}

}  // namespace semview::cli
