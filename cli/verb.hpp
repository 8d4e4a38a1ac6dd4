// SPDX-License-Identifier: Apache-2.0
/// What every verb of `semview` shares. A verb is one file: it reads its options, calls the
/// modules and prints; it holds no algorithm.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"

namespace CLI {
class App;
}

namespace semview::cli {

// Exit codes: 0 done, 1 failed (the reason is on standard error), 2 wrong usage.
inline constexpr int kExitFailed = 1;
inline constexpr int kExitUsage = 2;

/// Adds a verb to `app`; when it has run, `exit_code` holds the program's exit code.
void add_map_verb(CLI::App& app, int& exit_code);
void add_precompute_verb(CLI::App& app, int& exit_code);
void add_fuse_verb(CLI::App& app, int& exit_code);
void add_cache_verb(CLI::App& app, int& exit_code);
void add_weights_verb(CLI::App& app, int& exit_code);
void add_view_verb(CLI::App& app, int& exit_code);
void add_simulate_verb(CLI::App& app, int& exit_code);
void add_evaluate_verb(CLI::App& app, int& exit_code);
void add_score_verb(CLI::App& app, int& exit_code);
void add_heatmap_verb(CLI::App& app, int& exit_code);
void add_localize_verb(CLI::App& app, int& exit_code);
void add_observe_verb(CLI::App& app, int& exit_code);
void add_locate_verb(CLI::App& app, int& exit_code);
void add_bench_verb(CLI::App& app, int& exit_code);

/// 0, or prints `semview: <message>` (and the hint) on standard error and returns `kExitFailed`,
/// `kExitUsage` for `kInvalidArgument` with a field that starts with "--".
int report(const Status& status);

/// Has every option of `app` and its verbs that takes a whole number from 0 refuse what is none:
/// left to itself CLI11 reads -1 as the largest one. For after the verbs have been added.
void check_whole_numbers(CLI::App& app);

/// Degrees for people and scripts, to a billionth: -120, where pi leaves -119.99999999999999.
double shown_deg(double angle_rad);

/// The comma-separated numbers of an option, for example `1.5,-2,90`.
/// @errors kInvalidArgument: not exactly `count` finite numbers.
Result<std::vector<double>> parse_numbers(std::string_view option,
                                          const std::string& text,
                                          std::size_t count);

}  // namespace semview::cli
