// SPDX-License-Identifier: Apache-2.0
/// Finds the word that somebody meant. Inside the module only.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace semview::map::detail {

/// The one of `known` that `word` is most likely a slip of the keyboard for: at most one letter in
/// three added, left out, changed or swapped with its neighbour. Ties: the first.
std::optional<std::string_view> closest_word(std::string_view word,
                                             std::span<const std::string_view> known);

/// `did you mean X? ` if there is such a word, else nothing.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> known);

}  // namespace semview::map::detail
