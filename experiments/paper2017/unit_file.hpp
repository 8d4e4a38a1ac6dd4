// SPDX-License-Identifier: Apache-2.0
/// Where `--resume` finds what was done: a file of results a row and world.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "records.hpp"
#include "semview/core/result.hpp"

namespace semview::paper2017 {

/// `first_line` tells the settings; the last line tells that the file is whole.
std::string unit_text(std::span<const TrialRecord> drives, const std::string& first_line);

/// The results alone, a line a stop.
/// @errors those of reading; kFailedPrecondition: of other settings, cut or damaged; the hint says
/// what to do.
Result<std::string> read_unit(const std::filesystem::path& file, const std::string& first_line);

}  // namespace semview::paper2017
