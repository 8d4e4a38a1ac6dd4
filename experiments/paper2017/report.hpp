// SPDX-License-Identifier: Apache-2.0
/// All of the experiment's tables on one page, after what made them.
#pragma once

#include <string>

#include "results.hpp"

namespace semview::paper2017 {

/// What no seed decides.
struct ReportHeader {
  std::string command;
  std::string revision;
  std::string cpu;
  std::size_t threads = 1;
  double wall_s = 0.0;
};

/// The model that /proc/cpuinfo names; "unknown" where there is none.
std::string cpu_name();

/// Markdown.
std::string report(const Results& results, const ReportHeader& header);

}  // namespace semview::paper2017
