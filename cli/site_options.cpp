// SPDX-License-Identifier: Apache-2.0
#include "site_options.hpp"

#include <cstdlib>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "semview/cache/lmdb_store.hpp"
#include "semview/core/byte_size.hpp"
#include "semview/core/log.hpp"
#include "semview/geometry/angle.hpp"
#include "threads_option.hpp"
#include "verb.hpp"

namespace semview::cli {

void add_site_options(CLI::App& verb, SiteOptions& options, bool map_required) {
  verb.add_option("map", options.map, "Map: a bundle's folder, its map.yaml, a .glb, or a .vdb")
      ->type_name("MAP")
      ->required(map_required);
  add_engine_option(verb, options.engine);
  verb.add_option("--eye-height", options.eye_height_m, "Eye above the ground, metres")
      ->capture_default_str();
  verb.add_option("--columns", options.columns, "Columns of a panorama, a multiple of 120")
      ->capture_default_str();
  verb.add_option("--rows", options.rows, "Rows of a panorama")->capture_default_str();
  verb.add_option("--elevation", options.elevation_deg, "Lowest and highest elevation, degrees")
      ->type_name("MIN,MAX")
      ->capture_default_str();
  verb.add_option("--cache", options.cache_directory, "Keep views in this directory")
      ->type_name("DIR");
  verb.add_option("--cache-limit",
                  options.cache_limit,
                  "Store no more than this many bytes (500M, 20G); 0: as far as the disk goes")
      ->type_name("BYTES")
      ->capture_default_str();
  add_threads_option(verb, options.threads);
  verb.add_flag("--nearest-colour",
                options.nearest_colour,
                "Take a plan's in-between colours for the nearest class colour");
}

void add_engine_option(CLI::App& verb, std::string& engine) {
  // Not CLI11's own envname(): with it the option would count as given.
  const char* const wish = std::getenv("SEMVIEW_ENGINE");
  engine = wish != nullptr && *wish != '\0' ? wish : "auto";
  verb.add_option("--engine",
                  engine,
                  "What casts the views: auto, columns (plans only) or embree; SEMVIEW_ENGINE in "
                  "the environment is the default")
      ->capture_default_str();
}

void add_ranges_option(CLI::App& verb, SiteOptions& options) {
  verb.add_flag("--ranges",
                options.ranges,
                "Store the views with ranges, for a semview-server --ranges; scores need none");
}

Status check_left_to_server(const CLI::App& verb, std::initializer_list<const char*> options) {
  for (const char* option : options) {
    if (verb.get_option(option)->count() == 0) continue;
    return fail(
        Error{ErrorCode::kInvalidArgument,
              fmt::format("{}: is the server's own choice; leave it out with --server", option),
              option});
  }
  return {};
}

Status check_no_site_options(const CLI::App& verb) {
  return check_left_to_server(verb,
                              {"--engine",
                               "--eye-height",
                               "--columns",
                               "--rows",
                               "--elevation",
                               "--cache",
                               "--cache-limit",
                               "--nearest-colour"});
}

Result<service::SiteConfig> site_config(const SiteOptions& options) {
  service::SiteConfig config;
  SEMVIEW_TRY(const std::vector<double> elevation_deg,
              parse_numbers("--elevation", options.elevation_deg, 2));
  config.profile.camera.columns = options.columns;
  config.profile.camera.rows = options.rows;
  config.profile.camera.elevation_min_rad = rad_from_deg(elevation_deg[0]);
  config.profile.camera.elevation_max_rad = rad_from_deg(elevation_deg[1]);
  config.profile.eye_height_m = options.eye_height_m;
  config.profile.ranges = options.ranges;
  config.engine = options.engine;
  if (!options.cache_directory.empty()) config.cache_directory = options.cache_directory;
  SEMVIEW_TRY(config.cache_limit_bytes, parse_byte_size("--cache-limit", options.cache_limit));
  config.threads = options.threads;
  config.nearest_colour = options.nearest_colour;
  SEMVIEW_TRY_STATUS(service::validate(config));
  return config;
}

Result<std::shared_ptr<service::Site>> open_site(const SiteOptions& options) {
  SEMVIEW_TRY(const service::SiteConfig config, site_config(options));
  return service::Site::open(options.map, config);
}

void log_unusable_records(const service::Site& site, const std::string& cache_directory) {
  if (site.tiers().store == nullptr) return;
  const cache::StoreCounters disk = site.tiers().store->counters();
  const std::uint64_t unusable = disk.damaged + disk.foreign + disk.unknown;
  if (unusable == 0) return;
  log_warning(fmt::format(
      "cache {}: {} records could not be used, and their views were cast again: {} damaged, {} of "
      "other keys, {} of an unknown format",
      cache_directory,
      unusable,
      disk.damaged,
      disk.foreign,
      disk.unknown));
}

}  // namespace semview::cli
