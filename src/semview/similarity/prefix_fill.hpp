// SPDX-License-Identifier: Apache-2.0
/// Fills the entries of a PrefixTable, many groups at a time. Inside the module only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "semview/view/column_view.hpp"

namespace semview::similarity {

/// The shape of a table and where it lies, as PrefixTable has them.
struct PrefixEntries {
  std::int16_t* entries = nullptr;  ///< aligned to 64 bytes; all zero
  int residues = 1;
  int classes = 0;
  int first_group = 0;
  int groups = 0;
  std::size_t width = 0;
};

/// Writes every row but the first; padding stays zero. `weights_of_row` as in PrefixTable::fill.
void fill_prefix_entries(const PrefixEntries& table,
                         const LabelImage& labels,
                         std::span<const std::int16_t* const> weights_of_row);

}  // namespace semview::similarity
