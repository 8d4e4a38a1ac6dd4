// SPDX-License-Identifier: Apache-2.0
/// The small text tables of this module: lines, cells and numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace semview::similarity {

/// `text` without blanks, tabs and carriage returns at both ends.
std::string_view trim(std::string_view text);

/// A line and its number in the file, from 1.
struct TextLine {
  int number = 0;
  std::string_view text;
};

/// The lines, trimmed, that are neither empty nor start with #.
std::vector<TextLine> content_lines(std::string_view text);

/// The trimmed parts between separators; one part at least.
std::vector<std::string> split_trimmed(std::string_view text, char separator);

/// All of `text` as a finite number.
std::optional<double> parse_number(std::string_view text);

}  // namespace semview::similarity
