// SPDX-License-Identifier: Apache-2.0
#include "semview/map/yaml_fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "semview/map/spelling.hpp"

namespace semview::map::detail {
namespace {

std::string remedy_of(std::string_view example) {
  return example.empty() ? std::string() : fmt::format("write for example `{}`", example);
}

}  // namespace

std::optional<io::YamlNode> YamlFields::node(std::string_view key,
                                             Need need,
                                             std::string_view example) {
  std::optional<io::YamlNode> found = mapping_.find(key);
  if (found && found->is_null()) found.reset();
  if (!found && need == Need::kRequired && !misspelt(key)) {
    error(line(), fmt::format("{} is missing", key), remedy_of(example));
  }
  return found;
}

std::optional<double> YamlFields::number(std::string_view key,
                                         Need need,
                                         std::string_view example) {
  const std::optional<io::YamlNode> found = node(key, need, example);
  return found ? take(found->number(), remedy_of(example)) : std::nullopt;
}

std::optional<std::string> YamlFields::text(std::string_view key,
                                            Need need,
                                            std::string_view example) {
  const std::optional<io::YamlNode> found = node(key, need, example);
  return found ? take(found->text(), remedy_of(example)) : std::nullopt;
}

std::optional<bool> YamlFields::boolean(std::string_view key) {
  const std::optional<io::YamlNode> found = node(key, Need::kOptional);
  return found ? take(found->boolean()) : std::nullopt;
}

void YamlFields::expect_keys(std::vector<std::string_view> known) {
  std::vector<std::string_view> absent;
  for (const std::string_view key : known) {
    if (!mapping_.find(key)) absent.push_back(key);
  }
  for (const io::YamlNode::Entry& entry : mapping_.unknown_entries(known)) {
    if (const auto meant = closest_word(entry.key, absent)) misspelt_.emplace(*meant);
    error(entry.line,
          fmt::format("unknown key {}", entry.key),
          did_you_mean(entry.key, absent) + fmt::format("known here: {}", fmt::join(known, ", ")));
  }
}

void YamlFields::error(int line, std::string message, std::string remedy) {
  report_.problems.push_back(
      line_problem(Severity::kError, file_, line, std::move(message), std::move(remedy)));
}

void YamlFields::warning(int line, std::string message, std::string remedy) {
  report_.problems.push_back(
      line_problem(Severity::kWarning, file_, line, std::move(message), std::move(remedy)));
}

int YamlFields::line_of(std::string_view key) const {
  const std::optional<io::YamlNode> found = mapping_.find(key);
  return found ? found->line() : 0;
}

}  // namespace semview::map::detail
