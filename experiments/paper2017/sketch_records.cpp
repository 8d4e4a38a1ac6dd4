// SPDX-License-Identifier: Apache-2.0
#include "sketch_records.hpp"

#include <fmt/format.h>

#include "csv_fields.hpp"

namespace semview::paper2017 {
namespace {

constexpr std::size_t kColumns = 13;

std::string room_text(std::size_t room) {
  return room == kNoRoom ? std::string() : fmt::format("{}", room);
}

bool parse_room(std::string_view text, std::size_t& room) {
  room = kNoRoom;
  return text.empty() || parse_number(text, room);
}

bool parse_stop(const std::vector<std::string_view>& fields, SketchDrive& drive, SketchStop& stop) {
  int number = 0;
  drive.method = fields[2];
  drive.start = fields[3] == name(Start::kLocal) ? Start::kLocal : Start::kGlobal;
  return (fields[3] == name(Start::kLocal) || fields[3] == name(Start::kGlobal)) &&
         parse_number(fields[0], drive.world) && parse_number(fields[1], drive.sketch) &&
         parse_number(fields[4], drive.run) && parse_number(fields[5], number) &&
         parse_room(fields[6], stop.true_room) && parse_room(fields[7], stop.found_room) &&
         parse_number(fields[8], stop.true_place.x_m) &&
         parse_number(fields[9], stop.true_place.y_m) &&
         parse_number(fields[10], stop.estimate.x_m) &&
         parse_number(fields[11], stop.estimate.y_m) &&
         parse_number(fields[12], stop.estimate.yaw_rad);
}

bool same_drive(const SketchDrive& one, const SketchDrive& other) {
  return one.world == other.world && one.sketch == other.sketch && one.method == other.method &&
         one.start == other.start && one.run == other.run;
}

}  // namespace

std::string sketch_csv_header() {
  return "world,sketch,method,start,run,stop,true_room,found_room,true_x_m,true_y_m,x_m,y_m,"
         "yaw_rad\n";
}

std::string to_csv(std::span<const SketchDrive> drives) {
  std::string text = sketch_csv_header();
  for (const SketchDrive& drive : drives) {
    for (std::size_t i = 0; i < drive.stops.size(); ++i) {
      const SketchStop& stop = drive.stops[i];
      text += fmt::format("{},{},{},{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}\n",
                          drive.world,
                          drive.sketch,
                          drive.method,
                          name(drive.start),
                          drive.run,
                          i + 1,
                          room_text(stop.true_room),
                          room_text(stop.found_room),
                          stop.true_place.x_m,
                          stop.true_place.y_m,
                          stop.estimate.x_m,
                          stop.estimate.y_m,
                          stop.estimate.yaw_rad);
    }
  }
  return text;
}

Result<std::vector<SketchDrive>> parse_sketch_drives(std::string_view text,
                                                     std::string_view name_) {
  std::vector<SketchDrive> drives;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = take_line(text);
    if (line.empty() || line.front() == '#' || line.starts_with("world,")) continue;
    const std::vector<std::string_view> fields = fields_of(line);
    SketchDrive drive;
    SketchStop stop;
    if (fields.size() != kColumns || !parse_stop(fields, drive, stop)) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}:{}: expected {} fields as in the header, with local or global as "
                              "the fourth",
                              name_,
                              number,
                              kColumns));
    }
    if (drives.empty() || !same_drive(drives.back(), drive)) drives.push_back(drive);
    drives.back().stops.push_back(stop);
  }
  return drives;
}

}  // namespace semview::paper2017
