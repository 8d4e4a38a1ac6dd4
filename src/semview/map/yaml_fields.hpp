// SPDX-License-Identifier: Apache-2.0
/// Reads the fields of a YAML mapping and collects what is wrong with them. Inside the module only.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "semview/io/yaml_document.hpp"
#include "semview/map/map_problem.hpp"

namespace semview::map::detail {

enum class Need { kRequired, kOptional };

class YamlFields {
 public:
  YamlFields(io::YamlNode mapping, std::filesystem::path file, MapReport& report)
      : mapping_(std::move(mapping)), file_(std::move(file)), report_(report) {}

  /// The value of `key`; absent and required: an error, with `example` as what would be right,
  /// unless `expect_keys` has found it misspelt.
  std::optional<io::YamlNode> node(std::string_view key, Need need, std::string_view example = {});
  std::optional<double> number(std::string_view key, Need need, std::string_view example = {});
  std::optional<std::string> text(std::string_view key, Need need, std::string_view example = {});
  std::optional<bool> boolean(std::string_view key);

  /// An error for every key that is not one of `known`, with the one that was probably meant.
  void expect_keys(std::vector<std::string_view> known);
  /// True if `expect_keys` has found another key that was probably meant to be `key`.
  bool misspelt(std::string_view key) const { return misspelt_.contains(key); }

  void error(int line, std::string message, std::string remedy = {});
  void warning(int line, std::string message, std::string remedy = {});
  /// The value of a result, or its error added to the report with `remedy` as what would be right.
  template <typename T>
  std::optional<T> take(Result<T> result, std::string remedy = {}) {
    if (result) return *std::move(result);
    report_.problems.push_back(problem_of(file_, result.error()));
    if (!remedy.empty()) report_.problems.back().remedy = std::move(remedy);
    return std::nullopt;
  }

  int line() const { return mapping_.line(); }
  /// The line of `key`'s value, or 0.
  int line_of(std::string_view key) const;

 private:
  io::YamlNode mapping_;
  std::filesystem::path file_;
  MapReport& report_;
  std::set<std::string, std::less<>> misspelt_;
};

}  // namespace semview::map::detail
