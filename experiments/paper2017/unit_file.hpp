// SPDX-License-Identifier: Apache-2.0
/// Where `--resume` finds what was done: a file of results a unit of work.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "semview/core/result.hpp"

namespace semview::paper2017 {

/// `first_line` tells the settings; the last line tells that the file is whole.
std::string unit_text(std::string_view csv, std::string_view first_line);

/// Whether results can be read, given them and their file's name.
using UnitCheck = std::function<Status(std::string_view, std::string_view)>;

/// The results alone, a line a stop, without `header`.
/// @errors those of reading; kFailedPrecondition: of other settings, cut or damaged; the hint says
/// what to do.
Result<std::string> read_unit(const std::filesystem::path& file,
                              std::string_view first_line,
                              std::string_view header,
                              const UnitCheck& check);

}  // namespace semview::paper2017
