// SPDX-License-Identifier: Apache-2.0
#include "semview/io/yaml_document.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include "semview/io/text_file.hpp"

namespace semview::io {

struct YamlNode::Tree {
  Kind kind = Kind::kNull;
  int line = 0;
  std::shared_ptr<const std::string> file;
  std::string key;  ///< of the mapping entry that holds this value
  int key_line = 0;
  std::string scalar;
  std::vector<std::shared_ptr<const Tree>> children;
};

namespace {

constexpr std::size_t kMaxBytes = std::size_t{16} << 20U;
constexpr int kMaxNodes = 1'000'000;
constexpr int kMaxDepth = 50;

using Tree = YamlNode::Tree;

int line_of(const YAML::Mark& mark) { return mark.line + 1; }

/// Copies yaml-cpp's nodes into plain ones, so that no access can throw later.
class Copier {
 public:
  explicit Copier(const std::string& name) : file_(std::make_shared<std::string>(name)) {}

  Result<std::shared_ptr<Tree>> copy(const YAML::Node& node, int depth) {
    const int line = line_of(node.Mark());
    if (++nodes_ > kMaxNodes) return over_limit(line, "more than 1000000 values");
    if (depth > kMaxDepth) return over_limit(line, "more than 50 levels");
    auto tree = std::make_shared<Tree>();
    tree->file = file_;
    tree->line = line;
    if (node.IsScalar()) {
      tree->kind = YamlNode::Kind::kScalar;
      tree->scalar = node.Scalar();
    } else if (node.IsSequence()) {
      tree->kind = YamlNode::Kind::kSequence;
      for (const YAML::Node& item : node) {
        SEMVIEW_TRY(std::shared_ptr<Tree> child, copy(item, depth + 1));
        tree->children.push_back(std::move(child));
      }
    } else if (node.IsMap()) {
      SEMVIEW_TRY_STATUS(copy_entries(node, depth, *tree));
    }
    return tree;
  }

 private:
  Status copy_entries(const YAML::Node& node, int depth, Tree& tree) {
    tree.kind = YamlNode::Kind::kMapping;
    std::unordered_map<std::string, int> lines;
    for (const auto& entry : node) {
      const int line = line_of(entry.first.Mark());
      if (!entry.first.IsScalar()) return invalid(line, "a key must be a plain name");
      const std::string& key = entry.first.Scalar();
      SEMVIEW_TRY(std::shared_ptr<Tree> child, copy(entry.second, depth + 1));
      child->key = key;
      child->key_line = line;
      // An empty value has no place of its own.
      if (child->kind == YamlNode::Kind::kNull) child->line = line;
      const auto [first, is_new] = lines.emplace(key, line);
      if (!is_new) {
        return invalid(line, fmt::format("key '{}' was given in line {}", key, first->second));
      }
      tree.children.push_back(std::move(child));
    }
    return {};
  }

  tl::unexpected<Error> invalid(int line, std::string_view what) const {
    return fail(ErrorCode::kInvalidArgument, fmt::format("{}:{}: {}", *file_, line, what));
  }
  tl::unexpected<Error> over_limit(int line, std::string_view what) const {
    return fail(ErrorCode::kOutOfRange, fmt::format("{}:{}: {}", *file_, line, what));
  }

  std::shared_ptr<const std::string> file_;
  int nodes_ = 0;
};

template <typename Number>
bool parse_whole(std::string_view text, Number& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  return status == std::errc() && stop == text.data() + text.size();
}

std::string shown(const Tree& tree) {
  switch (tree.kind) {
    case YamlNode::Kind::kNull:
      return "nothing";
    case YamlNode::Kind::kScalar:
      return fmt::format("'{}'", tree.scalar);
    case YamlNode::Kind::kSequence:
      return fmt::format("a list of {}", tree.children.size());
    case YamlNode::Kind::kMapping:
      return "a mapping";
  }
  return {};
}

tl::unexpected<Error> not_a(const YamlNode& node, const Tree& tree, std::string_view expected) {
  const std::string subject = tree.key.empty() ? std::string() : tree.key + ": ";
  return node.error(fmt::format("{}{} is not {}", subject, shown(tree), expected));
}

/// The first line with a tab before its text, or 0.
int first_tabbed_line(std::string_view text) {
  for (int line = 1; !text.empty(); ++line) {
    const std::string_view indent = text.substr(0, text.find_first_not_of(" \t"));
    if (indent.find('\t') != std::string_view::npos && indent.size() < text.size()) return line;
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return 0;
}

}  // namespace

YamlNode::Kind YamlNode::kind() const { return tree_->kind; }
int YamlNode::line() const { return tree_->line; }
std::string YamlNode::where() const { return fmt::format("{}:{}", *tree_->file, tree_->line); }

tl::unexpected<Error> YamlNode::error(std::string_view what) const {
  return fail(Error{ErrorCode::kInvalidArgument, fmt::format("{}: {}", where(), what), tree_->key});
}

Result<std::string> YamlNode::text() const {
  if (!is_scalar()) return not_a(*this, *tree_, "a text");
  return tree_->scalar;
}

Result<double> YamlNode::number() const {
  double value = 0.0;
  if (!is_scalar() || !parse_whole(tree_->scalar, value) || !std::isfinite(value)) {
    return not_a(*this, *tree_, "a number");
  }
  return value;
}

Result<std::int64_t> YamlNode::integer() const {
  std::int64_t value = 0;
  if (!is_scalar() || !parse_whole(tree_->scalar, value)) {
    return not_a(*this, *tree_, "a whole number");
  }
  return value;
}

Result<bool> YamlNode::boolean() const {
  if (is_scalar() && tree_->scalar == "true") return true;
  if (is_scalar() && tree_->scalar == "false") return false;
  return not_a(*this, *tree_, "true or false");
}

Result<std::vector<double>> YamlNode::numbers(std::size_t count) const {
  if (!is_sequence() || tree_->children.size() != count) {
    return not_a(*this, *tree_, fmt::format("a list of {} numbers", count));
  }
  std::vector<double> values;
  for (const YamlNode& item : items()) {
    SEMVIEW_TRY(const double value, item.number());
    values.push_back(value);
  }
  return values;
}

Result<std::vector<std::string>> YamlNode::texts() const {
  if (!is_sequence()) return not_a(*this, *tree_, "a list of texts");
  std::vector<std::string> values;
  for (const YamlNode& item : items()) {
    SEMVIEW_TRY(std::string value, item.text());
    values.push_back(std::move(value));
  }
  return values;
}

std::vector<YamlNode> YamlNode::items() const {
  if (!is_sequence()) return {};
  std::vector<YamlNode> nodes;
  for (const auto& child : tree_->children) nodes.emplace_back(child);
  return nodes;
}

std::vector<YamlNode::Entry> YamlNode::entries() const {
  if (!is_mapping()) return {};
  std::vector<Entry> found;
  for (const auto& child : tree_->children) {
    found.push_back({child->key, child->key_line, YamlNode(child)});
  }
  return found;
}

std::optional<YamlNode> YamlNode::find(std::string_view key) const {
  if (!is_mapping()) return {};
  for (const auto& child : tree_->children) {
    if (child->key == key) return YamlNode(child);
  }
  return {};
}

Result<YamlNode> YamlNode::at(std::string_view key) const {
  if (!is_mapping()) return not_a(*this, *tree_, "a mapping");
  std::optional<YamlNode> found = find(key);
  if (!found) return error(fmt::format("key '{}' is missing", key));
  return *std::move(found);
}

std::vector<YamlNode::Entry> YamlNode::unknown_entries(
    std::span<const std::string_view> known) const {
  std::vector<Entry> unknown;
  for (Entry& entry : entries()) {
    if (std::ranges::find(known, entry.key) == known.end()) unknown.push_back(std::move(entry));
  }
  return unknown;
}

Status YamlNode::expect_keys(std::initializer_list<std::string_view> known) const {
  if (!is_mapping()) return not_a(*this, *tree_, "a mapping");
  const std::vector<Entry> unknown = unknown_entries({known.begin(), known.size()});
  if (unknown.empty()) return {};
  return fail(Error{ErrorCode::kInvalidArgument,
                    fmt::format("{}:{}: unknown key '{}', expected one of {}",
                                *tree_->file,
                                unknown.front().line,
                                unknown.front().key,
                                fmt::join(known, ", ")),
                    unknown.front().key});
}

Result<double> YamlNode::number_or(std::string_view key, double otherwise) const {
  const std::optional<YamlNode> value = find(key);
  return value ? value->number() : Result<double>(otherwise);
}
Result<std::int64_t> YamlNode::integer_or(std::string_view key, std::int64_t otherwise) const {
  const std::optional<YamlNode> value = find(key);
  return value ? value->integer() : Result<std::int64_t>(otherwise);
}
Result<bool> YamlNode::boolean_or(std::string_view key, bool otherwise) const {
  const std::optional<YamlNode> value = find(key);
  return value ? value->boolean() : Result<bool>(otherwise);
}
Result<std::string> YamlNode::text_or(std::string_view key, std::string otherwise) const {
  const std::optional<YamlNode> value = find(key);
  return value ? value->text() : Result<std::string>(std::move(otherwise));
}

std::string quoted_yaml(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20) {
      quoted += fmt::format("\\x{:02x}", c);
    } else {
      if (c == '"' || c == '\\') quoted += '\\';
      quoted += c;
    }
  }
  return quoted + '"';
}

Result<YamlNode> parse_yaml(const std::string& text, const std::string& name) {
  if (text.size() > kMaxBytes) {
    return fail(ErrorCode::kOutOfRange, fmt::format("{}: larger than 16 MiB", name));
  }
  try {
    SEMVIEW_TRY(std::shared_ptr<Tree> tree, Copier(name).copy(YAML::Load(text), 0));
    tree->line = std::max(tree->line, 1);
    return YamlNode(std::move(tree));
  } catch (const YAML::Exception& exception) {
    if (const int line = first_tabbed_line(text); line > 0) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}:{}: a tab indents this line; YAML wants spaces", name, line));
    }
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}:{}: not valid YAML: {}",
                            name,
                            std::max(line_of(exception.mark), 1),
                            exception.msg));
  } catch (const std::exception& exception) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: not valid YAML: {}", name, exception.what()));
  }
}

Result<YamlNode> read_yaml(const std::filesystem::path& path) {
  SEMVIEW_TRY(const std::string text, read_text_file(path, kMaxBytes));
  return parse_yaml(text, path.string());
}

}  // namespace semview::io
