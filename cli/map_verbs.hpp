// SPDX-License-Identifier: Apache-2.0
/// The verbs under `semview map`, one file each.
#pragma once

namespace CLI {
class App;
}

namespace semview::cli {

// Each adds its verb to `map`; when it has run, `exit_code` holds the program's exit code.
void add_map_check(CLI::App& map, int& exit_code);
void add_map_info(CLI::App& map, int& exit_code);
void add_map_pictures(CLI::App& map, int& exit_code);  ///< preview, occupancy
void add_map_import(CLI::App& map, int& exit_code);
void add_map_export(CLI::App& map, int& exit_code);

}  // namespace semview::cli
