// SPDX-License-Identifier: Apache-2.0
#include "semview/map/spelling.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace semview::map::detail {
namespace {

/// Longer words are no slips of short keys, and cost time.
constexpr std::size_t kLongestWord = 64;

/// Letters to add, leave out, change or swap with a neighbour (optimal string alignment).
std::size_t letters_between(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = i + j;
        continue;
      }
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
      }
    }
  }
  return cost[a.size()][b.size()];
}

}  // namespace

std::optional<std::string_view> closest_word(std::string_view word,
                                             std::span<const std::string_view> known) {
  if (word.size() > kLongestWord) return std::nullopt;
  std::optional<std::string_view> closest;
  std::size_t fewest = 0;
  for (const std::string_view candidate : known) {
    const std::size_t letters = letters_between(word, candidate);
    const std::size_t longer = std::max(word.size(), candidate.size());
    if (letters > std::max<std::size_t>(1, longer / 3) || letters >= candidate.size()) continue;
    if (closest && letters >= fewest) continue;
    closest = candidate;
    fewest = letters;
  }
  return closest;
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> known) {
  const std::optional<std::string_view> closest = closest_word(word, known);
  return closest ? fmt::format("did you mean {}? ", *closest) : std::string();
}

}  // namespace semview::map::detail
