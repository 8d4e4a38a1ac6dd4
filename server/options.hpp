// SPDX-License-Identifier: Apache-2.0
/// What semview-server is told: command line first, then `--config`, then defaults.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/service/site.hpp"
#include "server.hpp"

namespace semview::server {

struct MapOption {
  std::string id;  ///< empty: the map's own
  std::filesystem::path path;
};

struct Options {
  std::vector<MapOption> maps;
  service::SiteConfig site;
  ServerConfig server;
  unsigned drain_s = 10;  ///< how long SIGTERM lets work inside end
};

/// `[ID=]PATH`.
/// @errors kInvalidArgument, field `--map`: no id before the '=', or no path behind it.
Result<MapOption> parse_map_option(const std::string& text);

/// Reads `server.yaml` over `options`: maps are added, other keys replace. Its paths are relative
/// to its folder.
/// @errors those of io::read_yaml; kInvalidArgument with file and line.
Status read_config(const std::filesystem::path& path, Options* options);

/// True for addresses that only this machine can reach.
bool is_loopback(const std::string& endpoint);

}  // namespace semview::server
