// SPDX-License-Identifier: Apache-2.0
/// Places to write to, looked at before the work whose result goes there.
#pragma once

#include <filesystem>

#include "semview/core/result.hpp"

namespace semview::io {

/// Whether a file can be written (or replaced) at `path`: its folder is there and writable.
/// @errors kUnavailable, with what to do in the hint. Writing can still fail later: a disk fills.
Status check_output_file(const std::filesystem::path& path);

/// The same of a folder that is made, with those above it, if it is not there: whether one can be
/// is tried, and undone.
Status check_output_folder(const std::filesystem::path& path);

/// The error of a failed write: `error_number` is its `errno`.
tl::unexpected<Error> cannot_write(const std::filesystem::path& path, int error_number);

/// As `check_output_file`, for a picture that is written as PNG whatever its name says.
/// @errors also kInvalidArgument: the name has another ending than `.png`.
Status check_output_png(const std::filesystem::path& path);

}  // namespace semview::io
