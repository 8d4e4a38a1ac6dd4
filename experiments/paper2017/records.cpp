// SPDX-License-Identifier: Apache-2.0
#include "records.hpp"

#include <charconv>
#include <cstddef>
#include <system_error>

#include <fmt/format.h>

#include "semview/geometry/angle.hpp"

namespace semview::paper2017 {
namespace {

constexpr std::size_t kColumns = 19;

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

template <typename Number>
bool parse(std::string_view text, Number& number) {
  const char* const end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, number);
  return status == std::errc() && stop == end;
}

/// The fields after row, method and start.
bool parse_numbers(const std::vector<std::string_view>& fields,
                   TrialRecord& record,
                   StopRecord& stop) {
  std::uint64_t observation_seed = 0;
  double heading_deg = 0.0;
  const bool complete = parse(fields[3], record.world) && parse(fields[4], observation_seed) &&
                        parse(fields[5], record.filter_seed) && parse(fields[6], stop.stop) &&
                        parse(fields[7], stop.best_m) && parse(fields[8], stop.estimate_m) &&
                        parse(fields[9], stop.weighted_mean_m) && parse(fields[10], stop.mean_m) &&
                        parse(fields[11], stop.min_m) && parse(fields[12], heading_deg) &&
                        parse(fields[13], stop.odometry_m) && parse(fields[14], stop.particles) &&
                        parse(fields[15], stop.effective_sample_size) &&
                        parse(fields[16], stop.affine.a) && parse(fields[17], stop.affine.b) &&
                        parse(fields[18], stop.affine.k);
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
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line.front() == '#' || line.starts_with("row,")) continue;
    const std::vector<std::string_view> fields = split(line);
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
