// SPDX-License-Identifier: Apache-2.0
/// The table of claims: what is measured on which plans, and how it is run.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "semview/benchmark/interleave.hpp"
#include "semview/benchmark/office_plan.hpp"
#include "semview/benchmark/served_site.hpp"
#include "semview/benchmark/subject.hpp"
#include "semview/benchmark/table.hpp"
#include "semview/core/result.hpp"

namespace semview::benchmark {

struct SuiteConfig {
  std::vector<std::filesystem::path> maps = {};  ///< besides the generated plans
  std::vector<std::string> only = {};            ///< ids of rows; empty: all
  std::vector<std::size_t> threads = {1, 2};
  std::string engine = "auto";  ///< of rows that open a map as the service does
  /// One small plan, small panoramas and as few rounds as can be: checks that results agree, and
  /// its times say nothing.
  bool quick = false;
  Serve serve = {};  ///< none: rows over TCP say that there is no server
  /// Asked before each row: true ends the measurement with the rows so far.
  std::function<bool()> stopped = {};
  double budget_s = 0.6;  ///< of one measurement, beyond its fewest rounds
};

/// What can be measured, in the order of the table.
struct Claim {
  std::string id;
  std::string text;
};
std::vector<Claim> claims();

struct Progress {
  std::size_t done = 0;
  std::size_t rows = 0;
  double elapsed_s = 0.0;
  double remaining_s = 0.0;  ///< a guess
  const Row* next = nullptr;
};

/// Measures everything that `config` asks for. Before anything is timed its results are compared
/// with the alternative's; where they should agree and do not the row says so and has no times. A
/// row that cannot be measured says why; the others are measured all the same.
/// @errors kInvalidArgument: a row that there is none of, threads not in 1..256; those of
/// `map::load_map`.
Result<std::vector<Row>> run_suite(const SuiteConfig& config,
                                   const std::function<void(const Progress&)>& progress);

}  // namespace semview::benchmark
