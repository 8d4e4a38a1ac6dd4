// SPDX-License-Identifier: Apache-2.0
#include "sketch_units.hpp"

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "semview/core/hash.hpp"
#include "semview/io/text_file.hpp"
#include "sketch_records.hpp"
#include "unit_file.hpp"

namespace semview::paper2017 {
namespace {

Status check_drives(std::string_view csv, std::string_view name) {
  const auto drives = parse_sketch_drives(csv, name);
  return drives ? Status() : fail(drives.error());
}

}  // namespace

Result<SketchUnits> SketchUnits::open(const SketchSettings& settings,
                                      const std::string& described) {
  const std::filesystem::path directory = settings.out / "units";
  for (const auto& left : {directory, settings.out / "sketches.md"}) {
    if (settings.resume || !std::filesystem::exists(left)) continue;
    return fail(Error{
        ErrorCode::kFailedPrecondition,
        fmt::format(
            "{}: holds results already ({})", settings.out.string(), left.filename().string()),
        "--out",
        "go on with --resume, or choose another --out"});
  }
  Hasher hasher;
  hasher.add_string(described);
  SketchUnits made;
  made.first_line_ = fmt::format("# semview sketches, settings {}\n", to_hex(hasher.digest()));
  for (const std::uint64_t world : settings.worlds) {
    for (int sketch = 1; sketch <= settings.sketches; ++sketch) {
      Unit unit{world, sketch, directory / fmt::format("world_{}_sketch_{}.csv", world, sketch)};
      unit.finished = std::filesystem::exists(unit.file);
      if (unit.finished) {
        const auto csv = read_unit(unit.file, made.first_line_, sketch_csv_header(), check_drives);
        if (!csv) return fail(csv.error());
      }
      made.units_.push_back(std::move(unit));
    }
  }
  std::error_code ignored;
  std::filesystem::create_directories(directory, ignored);
  SEMVIEW_TRY_STATUS(io::write_text_file(settings.out / "settings.txt", described));
  return made;
}

Status SketchUnits::keep(const Unit& unit, std::span<const SketchDrive> drives) const {
  return io::write_text_file(unit.file, unit_text(to_csv(drives), first_line_));
}

Result<std::vector<SketchDrive>> SketchUnits::read_all() const {
  std::vector<SketchDrive> all;
  for (const Unit& unit : units_) {
    SEMVIEW_TRY(const std::string csv,
                read_unit(unit.file, first_line_, sketch_csv_header(), check_drives));
    SEMVIEW_TRY(std::vector<SketchDrive> drives, parse_sketch_drives(csv, unit.file.string()));
    std::ranges::move(drives, std::back_inserter(all));
  }
  return all;
}

}  // namespace semview::paper2017
