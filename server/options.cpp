// SPDX-License-Identifier: Apache-2.0
#include "options.hpp"

#include <algorithm>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "semview/core/byte_size.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/io/yaml_document.hpp"
#include "semview/map/map_limits.hpp"

namespace semview::server {
namespace {

/// A whole number in [minimum, maximum of T], if the key is there.
template <typename T>
Status read_count(const io::YamlNode& node, std::string_view key, T* value, std::int64_t minimum) {
  const auto found = node.find(key);
  if (!found) return {};
  SEMVIEW_TRY(const std::int64_t number, found->integer());
  const auto most = std::min<std::uint64_t>(std::numeric_limits<T>::max(),
                                            std::numeric_limits<std::int64_t>::max());
  if (number < minimum || static_cast<std::uint64_t>(number) > most) {
    return found->error(fmt::format("{} {}; expected {} to {}", key, number, minimum, most));
  }
  *value = static_cast<T>(number);
  return {};
}

/// A number of bytes such as 500M, if the key is there.
Status read_bytes(const io::YamlNode& node, std::string_view key, std::uint64_t* value) {
  const auto found = node.find(key);
  if (!found) return {};
  SEMVIEW_TRY(const std::string text, found->text());
  const Result<std::uint64_t> bytes = parse_byte_size(key, text);
  if (!bytes) return found->error(bytes.error().message);
  *value = *bytes;
  return {};
}

Status check_map_id(const std::string& text, const std::string& id) {
  if (map::is_map_id(id)) return {};
  return fail(Error{ErrorCode::kInvalidArgument,
                    fmt::format("map {}: '{}' is not an id; expected 1 to {} of a-z, 0-9, _ and -",
                                text,
                                id,
                                map::kMaxMapIdLength),
                    "--map"});
}

Status read_maps(const io::YamlNode& node,
                 const std::filesystem::path& folder,
                 std::vector<MapOption>* maps) {
  if (!node.is_sequence()) return node.error("maps: expected a list");
  for (const io::YamlNode& item : node.items()) {
    MapOption option;
    if (item.is_scalar()) {
      SEMVIEW_TRY(const std::string text, item.text());
      Result<MapOption> parsed = parse_map_option(text);
      if (!parsed) return item.error(parsed.error().message);
      option = *std::move(parsed);
    } else {
      SEMVIEW_TRY_STATUS(item.expect_keys({"id", "path"}));
      SEMVIEW_TRY(option.id, item.text_or("id", ""));
      SEMVIEW_TRY(const io::YamlNode path, item.at("path"));
      SEMVIEW_TRY(option.path, path.text());
      const bool named = item.find("id").has_value();
      if (Status status = check_map_id(option.path, option.id); named && !status) {
        return item.error(status.error().message);
      }
    }
    option.path = folder / option.path;
    maps->push_back(std::move(option));
  }
  return {};
}

Status read_profile(const io::YamlNode& node, ViewProfile* profile) {
  SEMVIEW_TRY_STATUS(
      node.expect_keys({"columns", "rows", "elevation_deg", "eye_height", "ranges"}));
  SEMVIEW_TRY_STATUS(read_count(node, "columns", &profile->camera.columns, 1));
  SEMVIEW_TRY_STATUS(read_count(node, "rows", &profile->camera.rows, 1));
  if (const auto elevation = node.find("elevation_deg")) {
    SEMVIEW_TRY(const std::vector<double> limits, elevation->numbers(2));
    profile->camera.elevation_min_rad = rad_from_deg(limits[0]);
    profile->camera.elevation_max_rad = rad_from_deg(limits[1]);
  }
  SEMVIEW_TRY(profile->eye_height_m, node.number_or("eye_height", profile->eye_height_m));
  SEMVIEW_TRY(profile->ranges, node.boolean_or("ranges", profile->ranges));
  if (Status status = validate(*profile); !status) return node.error(status.error().message);
  return {};
}

Status read_limits(const io::YamlNode& node, ServerConfig* server) {
  service::Limits& limits = server->limits;
  SEMVIEW_TRY_STATUS(node.expect_keys({"message_bytes",
                                       "poses",
                                       "curve_poses",
                                       "distorted_poses",
                                       "views",
                                       "view_pixels",
                                       "request_pixels",
                                       "heat_map_cells",
                                       "observations",
                                       "observation_bytes",
                                       "observations_per_client",
                                       "in_flight_per_client",
                                       "queued_cells",
                                       "queued_bytes",
                                       "clients",
                                       "running_jobs",
                                       "default_deadline_ms",
                                       "max_deadline_ms"}));
  SEMVIEW_TRY_STATUS(read_count(node, "message_bytes", &limits.max_message_bytes, 1024));
  if (limits.max_message_bytes > std::size_t{1} << 30U) {
    return node.error("message_bytes is above 1 GiB, the most that a message can hold");
  }
  SEMVIEW_TRY_STATUS(read_count(node, "poses", &limits.max_poses, 1));
  SEMVIEW_TRY_STATUS(read_count(node, "curve_poses", &limits.max_curve_poses, 1));
  SEMVIEW_TRY_STATUS(read_count(node, "distorted_poses", &limits.max_distorted_poses, 1));
  SEMVIEW_TRY_STATUS(read_count(node, "views", &limits.max_views, 1));
  SEMVIEW_TRY_STATUS(read_count(node, "view_pixels", &limits.max_pixels, 1));
  SEMVIEW_TRY_STATUS(read_count(node, "request_pixels", &limits.max_request_pixels, 1));
  SEMVIEW_TRY_STATUS(read_count(node, "heat_map_cells", &limits.max_heat_map_cells, 1));
  SEMVIEW_TRY_STATUS(read_count(node, "observations", &limits.max_observations, 1));
  SEMVIEW_TRY_STATUS(read_count(node, "observation_bytes", &limits.max_observation_bytes, 1));
  SEMVIEW_TRY_STATUS(
      read_count(node, "observations_per_client", &limits.max_observations_per_client, 1));
  SEMVIEW_TRY_STATUS(read_count(node, "in_flight_per_client", &limits.max_in_flight_per_client, 1));
  SEMVIEW_TRY_STATUS(read_count(node, "queued_cells", &limits.max_queued_cells, 1));
  SEMVIEW_TRY_STATUS(read_count(node, "queued_bytes", &server->max_queued_bytes, 1024));
  SEMVIEW_TRY_STATUS(read_count(node, "clients", &limits.max_clients, 1));
  SEMVIEW_TRY_STATUS(read_count(node, "running_jobs", &limits.max_running_jobs, 1));
  SEMVIEW_TRY_STATUS(read_count(node, "default_deadline_ms", &server->default_deadline_ms, 1));
  return read_count(node, "max_deadline_ms", &server->max_deadline_ms, 1);
}

}  // namespace

Result<MapOption> parse_map_option(const std::string& text) {
  const std::size_t equals = text.find('=');
  // A '=' after a '/' is part of a path.
  const bool named = equals != std::string::npos && text.find('/') > equals;
  const MapOption option =
      named ? MapOption{text.substr(0, equals), text.substr(equals + 1)} : MapOption{"", text};
  if (named) SEMVIEW_TRY_STATUS(check_map_id(text, option.id));
  if (option.path.empty()) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("map {}: no path; expected [ID=]FOLDER or [ID=]FILE.glb", text),
                      "--map"});
  }
  return option;
}

Status read_config(const std::filesystem::path& path, Options* options) {
  SEMVIEW_TRY(const io::YamlNode root, io::read_yaml(path));
  SEMVIEW_TRY_STATUS(root.expect_keys({"maps",
                                       "bind",
                                       "events",
                                       "events_port",
                                       "cache",
                                       "cache_limit",
                                       "memory",
                                       "threads",
                                       "engine",
                                       "nearest_colour",
                                       "profile",
                                       "limits",
                                       "drain_s"}));
  const std::filesystem::path folder = path.parent_path();
  if (const auto maps = root.find("maps")) {
    SEMVIEW_TRY_STATUS(read_maps(*maps, folder, &options->maps));
  }
  SEMVIEW_TRY(options->server.bind, root.text_or("bind", options->server.bind));
  SEMVIEW_TRY(options->server.events, root.boolean_or("events", options->server.events));
  SEMVIEW_TRY_STATUS(read_count(root, "events_port", &options->server.events_port, 0));
  if (const auto cache = root.find("cache")) {
    SEMVIEW_TRY(const std::string text, cache->text());
    options->site.cache_directory = folder / text;
  }
  SEMVIEW_TRY_STATUS(read_bytes(root, "cache_limit", &options->site.cache_limit_bytes));
  SEMVIEW_TRY_STATUS(read_bytes(root, "memory", &options->site.memory_bytes));
  SEMVIEW_TRY_STATUS(read_count(root, "threads", &options->site.threads, 0));
  SEMVIEW_TRY(options->site.engine, root.text_or("engine", options->site.engine));
  SEMVIEW_TRY(options->site.nearest_colour,
              root.boolean_or("nearest_colour", options->site.nearest_colour));
  if (const auto profile = root.find("profile")) {
    SEMVIEW_TRY_STATUS(read_profile(*profile, &options->site.profile));
  }
  if (const auto limits = root.find("limits")) {
    SEMVIEW_TRY_STATUS(read_limits(*limits, &options->server));
  }
  return read_count(root, "drain_s", &options->drain_s, 0);
}

bool is_loopback(const std::string& endpoint) {
  return endpoint.starts_with("tcp://127.") || endpoint.starts_with("tcp://lo:") ||
         endpoint.starts_with("tcp://[::1]:");
}

}  // namespace semview::server
