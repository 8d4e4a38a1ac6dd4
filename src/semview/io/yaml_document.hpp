// SPDX-License-Identifier: Apache-2.0
/// YAML files read so that every complaint names file and line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"

namespace semview::io {

/// A value in a YAML file that knows where it stands. Copies share the document.
///
/// Limits: 16 MiB of text, 1 000 000 values (aliases counted each time), 50 levels.
class YamlNode {
 public:
  enum class Kind { kNull, kScalar, kSequence, kMapping };

  Kind kind() const;
  bool is_null() const { return kind() == Kind::kNull; }
  bool is_scalar() const { return kind() == Kind::kScalar; }
  bool is_sequence() const { return kind() == Kind::kSequence; }
  bool is_mapping() const { return kind() == Kind::kMapping; }

  /// Line in the file, from 1; of a mapping or sequence, where it begins.
  int line() const;
  /// `map.yaml:12`
  std::string where() const;
  /// kInvalidArgument with the message `map.yaml:12: <what>`; `field` is this node's key, if it
  /// has one.
  tl::unexpected<Error> error(std::string_view what) const;

  /// This value as text, a finite number, a whole number, or true/false.
  /// @errors kInvalidArgument with place, value and what was expected.
  Result<std::string> text() const;
  Result<double> number() const;
  Result<std::int64_t> integer() const;
  Result<bool> boolean() const;
  /// A sequence of exactly `count` finite numbers.
  Result<std::vector<double>> numbers(std::size_t count) const;
  /// A sequence of texts.
  Result<std::vector<std::string>> texts() const;

  /// The items of a sequence; none of anything else.
  std::vector<YamlNode> items() const;

  struct Entry;
  /// The entries of a mapping in the order of the file; none of anything else.
  std::vector<Entry> entries() const;
  /// The value of `key` if this is a mapping that has it. `key: ` with no value is a null node.
  std::optional<YamlNode> find(std::string_view key) const;
  /// @errors kInvalidArgument: not a mapping, or no such key.
  Result<YamlNode> at(std::string_view key) const;

  /// The entries whose key is not one of `known`, for readers that report every problem.
  std::vector<Entry> unknown_entries(std::span<const std::string_view> known) const;
  /// @errors kInvalidArgument: not a mapping, or the first key that is not one of `known`.
  Status expect_keys(std::initializer_list<std::string_view> known) const;

  // The value of `key`, or `otherwise` where the key is absent.
  Result<double> number_or(std::string_view key, double otherwise) const;
  Result<std::int64_t> integer_or(std::string_view key, std::int64_t otherwise) const;
  Result<bool> boolean_or(std::string_view key, bool otherwise) const;
  Result<std::string> text_or(std::string_view key, std::string otherwise) const;

  struct Tree;  // private to the .cpp
  explicit YamlNode(std::shared_ptr<const Tree> tree) : tree_(std::move(tree)) {}

 private:
  std::shared_ptr<const Tree> tree_;
};

struct YamlNode::Entry {
  std::string key;
  int line = 0;  ///< of the key
  YamlNode value;
};

/// Reads the first document of a file.
/// @errors kNotFound: cannot be read; kInvalidArgument: not YAML, or a key twice in one mapping;
/// kOutOfRange: above a limit.
Result<YamlNode> read_yaml(const std::filesystem::path& path);

/// The same of a text; `name` stands for the file in messages.
Result<YamlNode> parse_yaml(const std::string& text, const std::string& name);

/// `text` in double quotes, for writers: any bytes come back as they were.
std::string quoted_yaml(std::string_view text);

}  // namespace semview::io
