// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/vocabulary.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "semview/similarity/shipped_tables.hpp"
#include "semview/similarity/text_table.hpp"

namespace semview::similarity {
namespace {

constexpr std::uintmax_t kMaxVocabularyBytes = 1U << 20U;
constexpr std::size_t kMaxNameBytes = 64;

/// What keeps `name` from being a class's name, for example because the file is a table of another
/// kind or no text; empty: nothing.
std::string objection(const std::string& name) {
  if (name.empty()) return "empty class name";
  if (std::ranges::any_of(name, [](unsigned char byte) { return byte < 0x20 || byte == 0x7f; })) {
    return "control characters in a class name, expected a text file";
  }
  if (name.size() > kMaxNameBytes) {
    return fmt::format("class name of {} bytes, expected at most {}", name.size(), kMaxNameBytes);
  }
  if (name.find_first_of(",;") != std::string::npos) {
    return "',' or ';' in a class name, expected a name, a tab, other names with ';' between them";
  }
  return {};
}

}  // namespace

ClassTable class_table(const Vocabulary& vocabulary) {
  std::vector<std::string> names;
  for (const NamedClass& named : vocabulary) names.push_back(named.name);
  return ClassTable(std::move(names));
}

Result<Vocabulary> parse_vocabulary(std::string_view text, std::string_view name) {
  Vocabulary vocabulary;
  for (const TextLine& line : content_lines(text)) {
    const auto wrong = [&](const std::string& what) {
      return fail(ErrorCode::kInvalidArgument, fmt::format("{}:{}: {}", name, line.number, what));
    };
    const std::vector<std::string> cells = split_trimmed(line.text, '\t');
    if (cells.size() > 2) return wrong("expected a name, a tab, other names with ';' between them");
    if (const std::string what = objection(cells[0]); !what.empty()) return wrong(what);
    if (std::ranges::find(vocabulary, cells[0], &NamedClass::name) != vocabulary.end()) {
      return wrong(fmt::format("class {} named twice", cells[0]));
    }
    if (vocabulary.size() >= kMaxClasses) {
      return wrong(fmt::format("more than {} classes", kMaxClasses));
    }
    vocabulary.push_back({cells[0]});
    if (cells.size() == 2) vocabulary.back().aliases = split_trimmed(cells[1], ';');
  }
  if (vocabulary.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: no classes, expected one name a line", name));
  }
  return vocabulary;
}

Result<Vocabulary> shipped_vocabulary(std::string_view id) {
  if (id == "ade20k150") return parse_vocabulary(kAde20k150Names, "ade20k150");
  if (id == "ade20k32") return parse_vocabulary(kAde20k32Names, "ade20k32");
  return fail(
      ErrorCode::kNotFound,
      fmt::format("vocabulary {}: not built in, expected ade20k150, ade20k32 or a file", id));
}

Result<Vocabulary> load_vocabulary(const std::string& id_or_file) {
  std::error_code no_file;
  const std::uintmax_t size = std::filesystem::file_size(id_or_file, no_file);
  if (no_file) return shipped_vocabulary(id_or_file);
  if (size > kMaxVocabularyBytes) {
    return fail(
        ErrorCode::kResourceExhausted,
        fmt::format("{}: {} bytes, expected at most {}", id_or_file, size, kMaxVocabularyBytes));
  }
  std::ifstream file(id_or_file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return parse_vocabulary(text, id_or_file);
}

}  // namespace semview::similarity
