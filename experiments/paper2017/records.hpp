// SPDX-License-Identifier: Apache-2.0
/// The experiment's results as CSV: a line a run and stop.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "methods.hpp"
#include "semview/core/result.hpp"
#include "trial.hpp"

namespace semview::paper2017 {

/// One drive: a row, a method, a start, a world and a filter seed.
struct TrialRecord {
  std::string row;
  std::string method;
  Start start = Start::kLocal;
  std::uint64_t world = 1;
  std::uint64_t filter_seed = 1;
  std::vector<StopRecord> stops;
};

/// The first line of `to_csv`'s, with its line end.
std::string csv_header();

/// A line a stop. Equal records make equal bytes on every machine.
std::string to_csv(const TrialRecord& record);

/// What `to_csv` wrote, with or without header and lines that begin with '#'.
/// @errors kInvalidArgument with `name` and line.
Result<std::vector<TrialRecord>> parse_trials(std::string_view text, std::string_view name);

/// The same for what differs from run to run: times, and where views came from.
std::string times_csv_header();
std::string times_csv(const TrialRecord& record);

}  // namespace semview::paper2017
