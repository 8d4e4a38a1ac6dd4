// SPDX-License-Identifier: Apache-2.0
/// The options of every verb that opens a map in this process.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <string>

#include "semview/core/result.hpp"
#include "semview/service/site.hpp"

namespace CLI {
class App;
}

namespace semview::cli {

/// As given on the command line.
struct SiteOptions {
  std::string map;  ///< the positional MAP: bundle folder, map.yaml, .glb or .vdb
  std::string engine;
  double eye_height_m = 1.2;
  int columns = 360;
  int rows = 90;
  std::string elevation_deg = "-45,45";
  bool ranges = false;
  std::string cache_directory;
  std::string cache_limit = "0";  ///< bytes, or a number with K, M, G or T (powers of 1024)
  std::size_t threads = 0;
  bool nearest_colour = false;
};

/// Adds MAP, --engine, --eye-height, --columns, --rows, --elevation, --cache, --cache-limit,
/// --threads and --nearest-colour. `map_required` is false for verbs that may ask a server instead.
/// `options` must outlive the parse.
void add_site_options(CLI::App& verb, SiteOptions& options, bool map_required = true);

/// Adds --engine alone; its default is the environment variable SEMVIEW_ENGINE, else auto.
void add_engine_option(CLI::App& verb, std::string& engine);

/// Adds --ranges, where views of cells are asked for their ranges.
void add_ranges_option(CLI::App& verb, SiteOptions& options);

/// Where `verb` asks a server: none of `options` was given.
/// @errors kInvalidArgument, with the option as the field.
Status check_left_to_server(const CLI::App& verb, std::initializer_list<const char*> options);

/// Where `verb` asks a server: none of the options that are the server's own choice was given.
/// @errors kInvalidArgument, with the option as the field.
Status check_no_site_options(const CLI::App& verb);

/// @errors kInvalidArgument, with the option as the field.
Result<service::SiteConfig> site_config(const SiteOptions& options);

/// Reads the options and opens the map.
Result<std::shared_ptr<service::Site>> open_site(const SiteOptions& options);

/// A line on the log if the cache directory held records that could not be used; call it at the
/// end.
void log_unusable_records(const service::Site& site, const std::string& cache_directory);

}  // namespace semview::cli
