// SPDX-License-Identifier: Apache-2.0
/// The likelihoods that codec 2 would have if it were made for some maps.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "semview/view/column_view.hpp"
#include "semview/view/view_situations.hpp"

namespace semview::bench {

/// How often each symbol came in each situation, a view, every map of one weight.
using SymbolCounts =
    std::array<std::array<double, detail::kMostSymbols>, detail::ViewSituations::kCount>;

/// Adds the symbols of one map's views, which come in blocks of 64.
void count_symbols(std::span<const std::vector<ColumnView>> blocks, SymbolCounts& counts);

/// As the table of src/semview/view/view_situations.cpp.
void print_likelihoods(const SymbolCounts& counts);

}  // namespace semview::bench
