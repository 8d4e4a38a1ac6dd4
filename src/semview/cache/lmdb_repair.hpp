// SPDX-License-Identifier: Apache-2.0
/// A damaged data file set aside, its sound records kept; for the sources of this module.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "semview/cache/lmdb_store.hpp"
#include "semview/core/result.hpp"

namespace semview::cache::detail {

/// Follows the pages of a directory's data file (`check_pages`). If they are damaged, every sound
/// record and description that the file's bytes still hold goes into a new data file, the damaged
/// one is renamed
/// (`data.mdb.damaged`, `data.mdb.damaged.2`, …), and a line in the log says so. A missing or empty
/// data file is sound: no rescue. Only for a process that has the directory to itself.
/// @errors kFailedPrecondition: the file never was a cache's; kDataLoss: the new file cannot be
/// written, nothing was changed.
Result<std::optional<Rescue>> mend_data_file(const std::filesystem::path& directory,
                                             std::uint64_t map_bytes);

/// Follows the pages of a data file that cannot be mended here.
/// @errors kDataLoss: damaged; kPermissionDenied, kUnavailable: it cannot be read.
Status check_data_file(const std::filesystem::path& directory);

}  // namespace semview::cache::detail
