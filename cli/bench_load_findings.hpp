// SPDX-License-Identifier: Apache-2.0
/// What `semview bench load` was asked for and what it has found, for people and for programs.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "client/load/kernel_time.hpp"
#include "client/load/most_robots.hpp"
#include "client/load/open_loop.hpp"
#include "site_options.hpp"

namespace semview::cli {

/// The load that was asked for.
struct LoadOptions {
  SiteOptions site;
  std::string server;  ///< empty: one in this process
  client::LoadConfig load;
  std::string kind = "global";
  bool cold = false;
  bool search = false;
  bool json = false;
};

/// What a server did under it.
struct LoadFindings {
  std::string map_id;
  std::string engine, engine_reason;
  std::size_t threads = 0;  ///< of the server; 0: one in another process, which does not tell
  std::size_t cores = 0;
  client::KernelTime kernel;
  std::vector<client::LoadStep> steps;
  std::optional<std::size_t> most_robots;
  std::size_t fewest_robots = 1;  ///< that a search tries
  bool settled = false;

  double ceiling(const client::LoadConfig& load) const {
    return kernel.robots(cores, load.rate_hz);
  }
};

void print_text(const LoadOptions& options, const LoadFindings& findings);
void print_json(const LoadOptions& options, const LoadFindings& findings);

}  // namespace semview::cli
