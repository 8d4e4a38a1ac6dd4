// SPDX-License-Identifier: Apache-2.0
/// Verbs under `semview evaluate` that have a file of their own.
#pragma once

namespace CLI {
class App;
}

namespace semview::cli {

void add_evaluate_lost_verb(CLI::App& evaluate, int& exit_code);
void add_evaluate_images(CLI::App& evaluate_verb, int& exit_code);
void add_evaluate_logs_verb(CLI::App& evaluate, int& exit_code);
void add_evaluate_paper2017_verb(CLI::App& evaluate, int& exit_code);
void add_evaluate_paper2023_verb(CLI::App& evaluate, int& exit_code);
void add_evaluate_rooms_verb(CLI::App& evaluate, int& exit_code);
void add_evaluate_sketches_verb(CLI::App& evaluate, int& exit_code);

}  // namespace semview::cli
