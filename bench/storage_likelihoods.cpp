// SPDX-License-Identifier: Apache-2.0
#include "storage_likelihoods.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "semview/view/view_codec_2.hpp"
#include "semview/view/view_situations.hpp"

namespace semview::bench {

void count_symbols(std::span<const std::vector<ColumnView>> blocks, SymbolCounts& counts) {
  for (const std::vector<ColumnView>& block : blocks) {
    for (const ColumnView& view : block) {
      const detail::SymbolWriter writer = detail::symbols_of(view);
      for (const detail::SymbolWriter::Symbol& symbol : writer.symbols()) {
        counts[symbol.situation][symbol.symbol] +=
            1.0 / (64.0 * static_cast<double>(blocks.size()));
      }
    }
  }
}

void print_likelihoods(const SymbolCounts& counts) {
  constexpr double kWhole = 1U << detail::kShareBits;
  constexpr double kSeen = 0.003;  // as if, once in so many views: none is ever impossible
  for (detail::Situation situation = 0; situation < counts.size(); ++situation) {
    const std::uint32_t symbols = detail::symbols_of(situation);
    double all = 0.0;
    for (std::uint32_t i = 0; i < symbols; ++i) all += counts[situation][i] + kSeen;
    std::vector<int> sizes;
    for (std::uint32_t i = 0; i < symbols; ++i) {
      const double share = (counts[situation][i] + kSeen) / all;
      sizes.push_back(1 + static_cast<int>(share * (kWhole - symbols)));
    }
    *std::ranges::max_element(sizes) +=
        static_cast<int>(kWhole) - std::accumulate(sizes.begin(), sizes.end(), 0);
    fmt::print("    {},\n", fmt::join(sizes, ", "));
  }
}

}  // namespace semview::bench
