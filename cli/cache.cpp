// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "semview/cache/lmdb_store.hpp"
#include "semview/geometry/angle.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

using cache::LmdbStore;

struct Options {
  std::string directory;
  bool json = false;
};

Result<cache::LmdbConfig> existing(const Options& options) {
  cache::LmdbConfig config;
  config.directory = options.directory;
  std::error_code error;
  if (!std::filesystem::is_regular_file(config.directory / "data.mdb", error)) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: not a cache directory (no data.mdb in it)", options.directory));
  }
  return config;
}

nlohmann::json to_json(const cache::KeyspaceEntry& entry) {
  if (!entry.described) {
    return {{"map", ""},
            {"views", entry.stored},
            {"record_bytes", entry.record_bytes},
            {"payload_bytes", entry.payload_bytes}};
  }
  const ViewProfile& profile = entry.keyspace.profile;
  return {{"map", entry.map_id},
          {"fingerprint", to_hex(entry.keyspace.map)},
          {"engine", entry.keyspace.engine},
          {"engine_version", entry.keyspace.engine_version},
          {"columns", profile.camera.columns},
          {"rows", profile.camera.rows},
          {"elevation_min_deg", deg_from_rad(profile.camera.elevation_min_rad)},
          {"elevation_max_deg", deg_from_rad(profile.camera.elevation_max_rad)},
          {"eye_height_m", profile.eye_height_m},
          {"ranges", profile.ranges},
          {"map_cells", entry.cells.size()},
          {"map_cells_stored", entry.stored_cells},
          {"complete", entry.complete()},
          {"views", entry.stored},
          {"record_bytes", entry.record_bytes},
          {"payload_bytes", entry.payload_bytes}};
}

void print(const cache::KeyspaceEntry& entry) {
  const ViewProfile& profile = entry.keyspace.profile;
  fmt::print("{}  {}\n",
             entry.map_id.empty() ? "(map not known)" : entry.map_id,
             entry.described ? to_hex(entry.keyspace.map) : "(its description is lost)");
  if (entry.described) {
    fmt::print("  views of   {} x {} pixels{}, {:g} to {:g} degrees, eye at {:g} m, by {} {}\n",
               profile.camera.columns,
               profile.camera.rows,
               profile.ranges ? " with ranges" : "",
               deg_from_rad(profile.camera.elevation_min_rad),
               deg_from_rad(profile.camera.elevation_max_rad),
               profile.eye_height_m,
               entry.keyspace.engine,
               entry.keyspace.engine_version);
  }
  fmt::print("  map cells  {} of {} stored, {}\n",
             entry.stored_cells,
             entry.cells.size(),
             entry.complete() ? "complete" : "not complete");
  fmt::print("  records    {}", entry.stored);
  if (entry.stored > 0) {
    fmt::print(", {} bytes ({} a view, {} of them its picture)",
               entry.record_bytes,
               entry.record_bytes / entry.stored,
               entry.payload_bytes / entry.stored);
  }
  fmt::print("\n");
}

Result<int> info(const Options& options) {
  SEMVIEW_TRY(const cache::LmdbConfig config, existing(options));
  SEMVIEW_TRY(const std::shared_ptr<LmdbStore> store, LmdbStore::open(config));
  SEMVIEW_TRY(const std::vector<cache::KeyspaceEntry> entries, store->keyspaces());
  if (options.json) {
    nlohmann::json json = {{"directory", options.directory},
                           {"file_bytes", store->file_bytes()},
                           {"maps", nlohmann::json::array()}};
    for (const cache::KeyspaceEntry& entry : entries) json["maps"].push_back(to_json(entry));
    fmt::print("{}\n", json.dump(2));
    return 0;
  }
  for (const cache::KeyspaceEntry& entry : entries) print(entry);
  fmt::print("{}: {} bytes in all\n", options.directory, store->file_bytes());
  return 0;
}

nlohmann::json to_json(const LmdbStore::VerifyReport& report) {
  return {{"records", report.records},
          {"sound", report.sound},
          {"damaged", report.damaged},
          {"foreign", report.foreign},
          {"unknown", report.unknown}};
}

void print(const LmdbStore::VerifyReport& report) {
  fmt::print("{} records: {} sound, {} damaged, {} of another key, {} of an unknown version\n",
             report.records,
             report.sound,
             report.damaged,
             report.foreign,
             report.unknown);
}

void add(nlohmann::json& json, const std::optional<cache::Rescue>& rescue) {
  if (!rescue) return;
  json["rescue"] = {
      {"views", rescue->views}, {"damage", rescue->damage}, {"set_aside", rescue->set_aside}};
}

Result<int> verify(const Options& options) {
  SEMVIEW_TRY(const cache::LmdbConfig config, existing(options));
  SEMVIEW_TRY(const std::shared_ptr<LmdbStore> store, LmdbStore::open(config));
  SEMVIEW_TRY(const LmdbStore::VerifyReport report, store->verify());
  if (options.json) {
    nlohmann::json json = to_json(report);
    add(json, store->rescue());
    fmt::print("{}\n", json.dump(2));
  } else {
    print(report);
  }
  if (store->rescue()) return kExitFailed;  // the log has said what was damaged
  if (report.sound == report.records) return 0;
  fmt::print(stderr,
             "semview: {} records cannot be used; their views are cast again when they are asked "
             "for\n  semview cache compact {} drops them\n",
             report.records - report.sound,
             options.directory);
  return kExitFailed;
}

Result<int> compact(const Options& options) {
  SEMVIEW_TRY(const cache::LmdbConfig config, existing(options));
  SEMVIEW_TRY(const LmdbStore::CompactReport report, LmdbStore::compact(config));
  if (options.json) {
    nlohmann::json json = to_json(report.found);
    add(json, report.rescue);
    json["bytes_before"] = report.bytes_before;
    json["bytes_after"] = report.bytes_after;
    fmt::print("{}\n", json.dump(2));
    return 0;
  }
  print(report.found);
  fmt::print("{} bytes before, {} now\n", report.bytes_before, report.bytes_after);
  return 0;
}

}  // namespace

void add_cache_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("cache", "Look at and tidy up a directory of stored views");
  verb->description(
      "A cache directory holds the views of any number of maps, one record a cell, each with its\n"
      "full key and a checksum. Views of a map that has changed stay until the directory is\n"
      "removed; they are never served for the new map. Whoever opens a directory first, these "
      "verbs\n"
      "included, replaces a damaged data file by a new one with every sound record of it.");
  verb->require_subcommand(1);
  auto options = std::make_shared<Options>();
  using Run = Result<int> (*)(const Options&);
  const auto add = [&](const char* name, const char* help, Run run) {
    CLI::App* part = verb->add_subcommand(name, help);
    part->add_option("directory", options->directory, "Cache directory")
        ->type_name("DIR")
        ->required();
    part->add_flag("--json", options->json, "Print JSON");
    part->callback([options, run, &exit_code] {
      const Result<int> code = run(*options);
      exit_code = code ? *code : report(fail(code.error()));
    });
  };
  add("info", "Which maps, how many views, complete or not, bytes", info);
  add("verify",
      "Read and check every record; exit 1 if one cannot be used or the file was damaged",
      verify);
  add("compact", "Drop records that cannot be used and rewrite the file densely", compact);
  verb->footer("Example:\n  semview cache info cache\n  semview cache verify cache --json");
}

}  // namespace semview::cli
