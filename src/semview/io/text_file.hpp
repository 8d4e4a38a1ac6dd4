// SPDX-License-Identifier: Apache-2.0
/// Whole files in and out, with errors that name the file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "semview/core/result.hpp"

namespace semview::io {

/// The bytes of a file.
/// @errors kNotFound: cannot be opened or read; kOutOfRange: larger than `max_bytes`.
Result<std::string> read_text_file(const std::filesystem::path& path, std::size_t max_bytes);

/// Replaces a file by `text`; a reader never sees half of it, and none is left if it fails.
/// @errors kUnavailable: cannot be written.
Status write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace semview::io
