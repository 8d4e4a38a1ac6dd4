// SPDX-License-Identifier: Apache-2.0
#include "records.hpp"

#include <cstddef>

#include <fmt/format.h>

#include "csv_fields.hpp"
#include "semview/geometry/angle.hpp"

namespace semview::paper2017 {
namespace {

constexpr std::size_t kColumns = 19;

/// The fields after row, method and start.
bool parse_numbers(const std::vector<std::string_view>& fields,
                   TrialRecord& record,
                   StopRecord& stop) {
  std::uint64_t observation_seed = 0;
  double heading_deg = 0.0;
  const bool complete =
      parse_number(fields[3], record.world) && parse_number(fields[4], observation_seed) &&
      parse_number(fields[5], record.filter_seed) && parse_number(fields[6], stop.stop) &&
      parse_number(fields[7], stop.best_m) && parse_number(fields[8], stop.estimate_m) &&
      parse_number(fields[9], stop.weighted_mean_m) && parse_number(fields[10], stop.mean_m) &&
      parse_number(fields[11], stop.min_m) && parse_number(fields[12], heading_deg) &&
      parse_number(fields[13], stop.odometry_m) && parse_number(fields[14], stop.particles) &&
      parse_number(fields[15], stop.effective_sample_size) &&
      parse_number(fields[16], stop.affine.a) && parse_number(fields[17], stop.affine.b) &&
      parse_number(fields[18], stop.affine.k);
  stop.heading_rad = rad_from_deg(heading_deg);
  return complete;
}

bool same_drive(const TrialRecord& one, const TrialRecord& other) {
  return one.row == other.row && one.method == other.method && one.start == other.start &&
         one.world == other.world && one.filter_seed == other.filter_seed;
}

}  // namespace

std::string csv_header() {
  return "row,method,start,world,observation_seed,filter_seed,stop,best_m,estimate_m,"
         "weighted_mean_m,mean_m,min_m,heading_deg,odometry_m,particles,effective_particles,"
         "map_a,map_b,map_k\n";
}

std::string to_csv(const TrialRecord& record) {
  std::string text;
  for (const StopRecord& stop : record.stops) {
    text += fmt::format(
        "{},{},{},{},{},{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.4f},{:.6f},{},{:.3f},{:.5f},"
        "{:.5f},{:.5f}\n",
        record.row,
        record.method,
        name(record.start),
        record.world,
        record.world,
        record.filter_seed,
        stop.stop,
        stop.best_m,
        stop.estimate_m,
        stop.weighted_mean_m,
        stop.mean_m,
        stop.min_m,
        deg_from_rad(stop.heading_rad),
        stop.odometry_m,
        stop.particles,
        stop.effective_sample_size,
        stop.affine.a,
        stop.affine.b,
        stop.affine.k);
  }
  return text;
}

Result<std::vector<TrialRecord>> parse_trials(std::string_view text, std::string_view name_) {
  std::vector<TrialRecord> records;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = take_line(text);
    if (line.empty() || line.front() == '#' || line.starts_with("row,")) continue;
    const std::vector<std::string_view> fields = fields_of(line);
    TrialRecord record;
    StopRecord stop;
    if (fields.size() != kColumns || (fields[2] != "local" && fields[2] != "global") ||
        !parse_numbers(fields, record, stop)) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}:{}: expected {} fields as in the header, with local or global as "
                              "the third",
                              name_,
                              number,
                              kColumns));
    }
    record.row = fields[0];
    record.method = fields[1];
    record.start = fields[2] == "local" ? Start::kLocal : Start::kGlobal;
    if (records.empty() || !same_drive(records.back(), record)) records.push_back(record);
    records.back().stops.push_back(stop);
  }
  return records;
}

std::string times_csv_header() {
  return "row,method,start,world,filter_seed,stop,update_ms,views_from_memory,views_cast\n";
}

std::string times_csv(const TrialRecord& record) {
  std::string text;
  for (const StopRecord& stop : record.stops) {
    text += fmt::format("{},{},{},{},{},{},{:.3f},{},{}\n",
                        record.row,
                        record.method,
                        name(record.start),
                        record.world,
                        record.filter_seed,
                        stop.stop,
                        1e3 * stop.update_s,
                        stop.origins.memory,
                        stop.origins.cast);
  }
  return text;
}

}  // namespace semview::paper2017
