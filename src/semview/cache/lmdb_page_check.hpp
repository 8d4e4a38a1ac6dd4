// SPDX-License-Identifier: Apache-2.0
/// Whether LMDB can walk a data file without harm; for the sources of this module.
#pragma once

#include <cstddef>
#include <span>

#include "semview/core/result.hpp"

namespace semview::cache::detail {

/// LMDB trusts the pages of its file: a pointer that leads astray ends the process. This follows
/// every page from the current root, tables and list of free pages included, as LMDB 0.9 lays them
/// out on a 64-bit little-endian machine (mdb.c: MDB_page, MDB_node, MDB_meta), and touches nothing
/// outside `file`. Nobody may write to the file meanwhile.
/// @errors kDataLoss: the first page that is not as it must be, and in what.
Status check_pages(std::span<const std::byte> file);

/// Whether a data file starts as those of LMDB 0.9 do, in either of its two first pages.
bool looks_like_lmdb(std::span<const std::byte> file);

}  // namespace semview::cache::detail
