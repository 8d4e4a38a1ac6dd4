// SPDX-License-Identifier: Apache-2.0
/// What benchmarks found, as rows of a table.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "semview/benchmark/interleave.hpp"

namespace semview::benchmark {

/// Two figures side by side, each at its least and its median over the rounds.
struct Finding {
  std::string unit;  ///< "s", "bytes", "%"; of one item, as the claim says
  double ours = 0.0;
  double ours_median = 0.0;
  double other = 0.0;
  double other_median = 0.0;
  double ratio = 0.0;  ///< of the least: other / ours, or as the claim words it
  double ratio_median = 0.0;
  int rounds = 0;
  std::string clock;      ///< "thread" or "wall"; "": no time
  std::string agreement;  ///< how far the results are the same
};

/// Times of one item: the ratio says how many times as long the other takes.
Finding finding_of(const Turns& turns, std::string agreement);

/// What a claim is held to.
struct Goal {
  std::string text;  ///< "at least 22x, then 60x"; "": none
  double value = 0.0;
  std::optional<double> then = {};  ///< where to go from there
  bool at_most = false;
  bool of_ours = false;  ///< bounds our own figure and not the ratio
};

struct Row {
  std::string id;  ///< what --only takes
  std::string claim;
  std::string subject;  ///< the plan
  std::string size;     ///< of a panorama, or other circumstances
  int threads = 1;
  std::string engine = {};  ///< of rows that open a map as the service does: what casts its views
  std::string engine_reason = {};  ///< and why it does
  Goal goal;
  std::optional<Finding> found;  ///< none: `note` says why
  std::string note;
  bool failed = false;     ///< it could not be measured, and not for want of a peer: see `note`
  bool disagrees = false;  ///< results that should be the same are not: it failed

  /// None without a finding or a goal.
  std::optional<bool> reached() const;
  /// The same of `goal.then`; none without that either.
  std::optional<bool> reached_then() const;
};

/// For a terminal, and to paste into Markdown.
std::string to_text(std::span<const Row> rows);
std::string to_markdown(std::span<const Row> rows);

/// Three digits with the prefix that fits: (0.0000123, "s") is "12.3 us".
std::string shown(double value, const std::string& unit);

}  // namespace semview::benchmark
