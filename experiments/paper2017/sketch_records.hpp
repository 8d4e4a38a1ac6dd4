// SPDX-License-Identifier: Apache-2.0
/// Drives on sketches as CSV: a line a stop.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"
#include "sketch_drives.hpp"

namespace semview::paper2017 {

/// The first line of `to_csv`'s, with its line end.
std::string sketch_csv_header();

/// One line a stop, with a header. Equal drives make equal bytes.
std::string to_csv(std::span<const SketchDrive> drives);

/// What `to_csv` wrote, with or without header and lines that begin with '#'.
/// @errors kInvalidArgument with `name` and line.
Result<std::vector<SketchDrive>> parse_sketch_drives(std::string_view text, std::string_view name);

}  // namespace semview::paper2017
