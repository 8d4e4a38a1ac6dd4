// SPDX-License-Identifier: Apache-2.0
#include "semview/protocol/map_wire.hpp"

#include <algorithm>
#include <limits>
#include <unordered_set>

#include <fmt/format.h>

#include "semview/protocol/envelope.hpp"

namespace semview::protocol {
namespace {

tl::unexpected<Error> broken(std::string message) {
  return fail(ErrorCode::kDataLoss, std::move(message));
}

Result<ClassTable> class_table(const v1::GetMapReply& wire) {
  if (wire.classes_size() > kMaxClasses) {
    return broken(
        fmt::format("classes: {}; expected at most {}", wire.classes_size(), kMaxClasses));
  }
  std::vector<std::string> names;
  std::unordered_set<std::string> seen;
  for (const v1::MapClass& entry : wire.classes()) {
    if (entry.name().empty() || !seen.insert(entry.name()).second) {
      return broken(fmt::format("classes: name '{}' is empty or there twice", entry.name()));
    }
    names.push_back(entry.name());
  }
  return ClassTable(std::move(names));
}

}  // namespace

std::string to_wire(const Fingerprint& fingerprint) {
  return {fingerprint.bytes.begin(), fingerprint.bytes.end()};
}

v1::MapSummary to_wire(const MapSummary& summary) {
  v1::MapSummary wire;
  wire.set_id(summary.id);
  wire.set_name(summary.name);
  wire.set_fingerprint(to_wire(summary.fingerprint));
  return wire;
}

Result<MapSummary> from_wire(const v1::MapSummary& wire) {
  MapSummary summary{wire.id(), wire.name(), {}};
  const std::string& bytes = wire.fingerprint();
  if (bytes.size() != summary.fingerprint.bytes.size()) {
    return broken(fmt::format("fingerprint: {} bytes; expected 16", bytes.size()));
  }
  std::transform(bytes.begin(), bytes.end(), summary.fingerprint.bytes.begin(), [](char byte) {
    return static_cast<std::uint8_t>(byte);
  });
  return summary;
}

v1::ViewProfile to_wire(const ViewProfile& profile) {
  v1::ViewProfile wire;
  wire.set_columns(static_cast<std::uint32_t>(profile.camera.columns));
  wire.set_rows(static_cast<std::uint32_t>(profile.camera.rows));
  wire.set_elevation_min_rad(profile.camera.elevation_min_rad);
  wire.set_elevation_max_rad(profile.camera.elevation_max_rad);
  wire.set_eye_height_m(profile.eye_height_m);
  wire.set_ranges(profile.ranges);
  return wire;
}

Result<ViewProfile> from_wire(const v1::ViewProfile& wire, std::string_view field) {
  // What no int holds is refused here, with the number that came.
  constexpr std::uint32_t kMaxInt = std::numeric_limits<std::int32_t>::max();
  if (wire.columns() > kMaxInt) {
    return wrong_field(fmt::format("{}.columns", field),
                       fmt::format("{}; expected at most {}", wire.columns(), kMaxPanoramaColumns));
  }
  if (wire.rows() > kMaxInt) {
    return wrong_field(fmt::format("{}.rows", field),
                       fmt::format("{}; expected at most {}", wire.rows(), kMaxPanoramaRows));
  }
  const ViewProfile profile{{static_cast<int>(wire.columns()),
                             static_cast<int>(wire.rows()),
                             wire.elevation_min_rad(),
                             wire.elevation_max_rad()},
                            wire.eye_height_m(),
                            wire.ranges()};
  if (Status status = semview::validate(profile); !status) {
    const Error& error = status.error();
    const bool minimum = !(profile.camera.elevation_min_rad >= -kPi / 2.0);
    // The profile's elevation is two fields on the wire.
    const std::string name = error.field != "elevation" ? error.field
                             : minimum                  ? "elevation_min_rad"
                                                        : "elevation_max_rad";
    return wrong_field(fmt::format("{}.{}", field, name), error.message);
  }
  return profile;
}

v1::CellRuns to_wire(std::span<const CellIndex> cells) {
  v1::CellRuns wire;
  for (std::size_t begin = 0; begin < cells.size();) {
    std::size_t end = begin + 1;
    while (end < cells.size() && cells[end].iy == cells[begin].iy &&
           cells[end].ix == cells[end - 1].ix + 1) {
      ++end;
    }
    wire.add_iy(cells[begin].iy);
    wire.add_ix(cells[begin].ix);
    wire.add_length(static_cast<std::uint32_t>(end - begin));
    begin = end;
  }
  return wire;
}

Result<std::vector<CellIndex>> from_wire(const v1::CellRuns& wire) {
  if (wire.ix_size() != wire.iy_size() || wire.ix_size() != wire.length_size()) {
    return broken("free_cells: ix, iy and length have unequal lengths");
  }
  std::size_t total = 0;
  for (int i = 0; i < wire.length_size(); ++i) {
    const std::int64_t end = std::int64_t{wire.ix(i)} + wire.length(i);
    total += wire.length(i);
    if (total > kMaxMapCells || end > std::numeric_limits<std::int32_t>::max()) {
      return broken(fmt::format("free_cells: run {} is too long", i));
    }
  }
  std::vector<CellIndex> cells;
  cells.reserve(total);
  for (int i = 0; i < wire.length_size(); ++i) {
    for (std::uint32_t k = 0; k < wire.length(i); ++k) {
      cells.push_back({wire.ix(i) + static_cast<std::int32_t>(k), wire.iy(i)});
    }
  }
  return cells;
}

v1::GetMapReply to_wire(const MapDescription& map) {
  v1::GetMapReply wire;
  *wire.mutable_summary() = to_wire(map.summary);
  for (std::size_t i = 0; i < map.classes.names().size(); ++i) {
    v1::MapClass* const entry = wire.add_classes();
    entry->set_name(map.classes.names()[i]);
    if (i < map.colors.size() && map.colors[i]) {
      const Rgb color = *map.colors[i];
      entry->set_color_rgb(std::string{
          static_cast<char>(color.r), static_cast<char>(color.g), static_cast<char>(color.b)});
    }
  }
  wire.set_ground_height_m(map.ground_height_m);
  *wire.mutable_profile() = to_wire(map.profile);
  wire.set_engine(map.engine);
  wire.set_engine_version(map.engine_version);
  wire.set_engine_reason(map.engine_reason);
  *wire.mutable_free_cells() = to_wire(std::span(map.free_cells));
  wire.set_glb(map.glb);
  wire.set_weights_csv(map.weights_csv);
  return wire;
}

Result<MapDescription> from_wire(const v1::GetMapReply& wire) {
  MapDescription map;
  SEMVIEW_TRY(map.summary, from_wire(wire.summary()));
  SEMVIEW_TRY(map.classes, class_table(wire));
  for (const v1::MapClass& entry : wire.classes()) {
    const std::string& rgb = entry.color_rgb();
    const auto byte = [&rgb](std::size_t i) { return static_cast<unsigned char>(rgb[i]); };
    if (!rgb.empty() && rgb.size() != 3) return broken("classes: color_rgb has not 3 bytes");
    map.colors.push_back(rgb.empty() ? std::nullopt
                                     : std::optional(Rgb{byte(0), byte(1), byte(2)}));
  }
  SEMVIEW_TRY(map.profile, from_wire(wire.profile(), "profile"));
  SEMVIEW_TRY(map.free_cells, from_wire(wire.free_cells()));
  map.ground_height_m = wire.ground_height_m();
  map.engine = wire.engine();
  map.engine_version = wire.engine_version();
  map.engine_reason = wire.engine_reason();
  map.glb = wire.glb();
  map.weights_csv = wire.weights_csv();
  return map;
}

v1::JobStatusReply to_wire(const JobProgress& progress) {
  v1::JobStatusReply wire;
  wire.set_job_id(progress.job_id);
  wire.set_map_id(progress.map_id);
  wire.set_state(static_cast<v1::JobState>(progress.state));
  wire.set_total_cells(progress.total_cells);
  wire.set_found_cells(progress.found_cells);
  wire.set_cast_cells(progress.cast_cells);
  wire.set_elapsed_s(progress.elapsed_s);
  wire.set_remaining_s(progress.remaining_s);
  if (progress.error) *wire.mutable_error() = to_wire(*progress.error);
  return wire;
}

Result<JobProgress> from_wire(const v1::JobStatusReply& wire) {
  if (wire.state() < v1::JOB_STATE_QUEUED || wire.state() > v1::JOB_STATE_CANCELLED) {
    return broken(fmt::format("state: {} is not known", static_cast<int>(wire.state())));
  }
  JobProgress progress;
  progress.job_id = wire.job_id();
  progress.map_id = wire.map_id();
  progress.state = static_cast<JobState>(wire.state());
  progress.total_cells = wire.total_cells();
  progress.found_cells = wire.found_cells();
  progress.cast_cells = wire.cast_cells();
  progress.elapsed_s = wire.elapsed_s();
  progress.remaining_s = wire.remaining_s();
  if (wire.has_error()) progress.error = from_wire(wire.error());
  return progress;
}

}  // namespace semview::protocol
