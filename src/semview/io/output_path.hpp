// SPDX-License-Identifier: Apache-2.0
/// Places to write to, looked at before the work whose result goes there.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "semview/core/result.hpp"

namespace semview::io {

/// Whether a file can be written (or replaced) at `path`: its folder is there and writable.
/// @errors kUnavailable, with what to do in the hint. Writing can still fail later: a disk fills.
///         kAlreadyExists: it is a file that a map, run log or observation consists of, and people
///         write those over by mistake only.
Status check_output_file(const std::filesystem::path& path);

/// The same of a folder that is made, with those above it, if it is not there: whether one can be
/// is tried, and undone.
Status check_output_folder(const std::filesystem::path& path);

/// Whether `path` is another file than all `inputs` of the same command, by whatever names.
/// @errors kAlreadyExists
Status check_is_no_input(const std::filesystem::path& path, std::span<const std::string> inputs);

/// What a folder of ours is: it says so by the one file that its format begins with.
enum class FolderKind { kMap, kRunLog, kObservation };

/// Whether a folder of this kind can be written at `path` without loss: it is not of another kind,
/// nor holds files of the names to come. One that is of this kind already is left to its writer.
/// @errors kAlreadyExists
Status check_holds_nothing_else(const std::filesystem::path& path, FolderKind kind);

/// The error of a failed write: `error_number` is its `errno`.
tl::unexpected<Error> cannot_write(const std::filesystem::path& path, int error_number);

/// As `check_output_file`, for a picture that is written as PNG whatever its name says.
/// @errors also kInvalidArgument: the name has another ending than `.png`.
Status check_output_png(const std::filesystem::path& path);

}  // namespace semview::io
