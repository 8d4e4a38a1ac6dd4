// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/synonym_table.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/similarity/shipped_tables.hpp"
#include "semview/similarity/text_table.hpp"

namespace semview::similarity {

double SynonymTable::Group::degree(std::string_view class_name) const {
  const auto member = std::ranges::find(members, class_name, &Member::name);
  return member == members.end() ? 0.0 : member->degree;
}

Result<std::size_t> SynonymTable::group_index(const std::string& name) const {
  const auto group = std::ranges::find(groups_, name, &Group::name);
  if (group == groups_.end()) {
    return fail(ErrorCode::kInvalidArgument, fmt::format("unknown group {}", name));
  }
  return static_cast<std::size_t>(group - groups_.begin());
}

Status SynonymTable::add_group(const std::vector<std::string>& cells) {
  const auto wrong = [](std::string what) {
    return fail(ErrorCode::kInvalidArgument, std::move(what));
  };
  if (std::ranges::find(groups_, cells[1], &Group::name) != groups_.end()) {
    return wrong(fmt::format("group {} appears twice", cells[1]));
  }
  const std::optional<double> significance = parse_number(cells[2]);
  if (!significance || !(*significance > 0.0 && *significance <= 1.0)) {
    return wrong(fmt::format("significance '{}', expected a number in (0, 1]", cells[2]));
  }
  Group group{cells[1], *significance, {}};
  for (const std::string& part : split_trimmed(cells[3], ';')) {
    const std::vector<std::string> name_and_degree = split_trimmed(part, '=');
    std::optional<double> degree = 1.0;
    if (name_and_degree.size() == 2) degree = parse_number(name_and_degree[1]);
    const bool named = !name_and_degree[0].empty() && name_and_degree.size() <= 2;
    if (!named || !degree || !(*degree > 0.0 && *degree <= 1.0)) {
      return wrong(fmt::format("member '{}', expected name or name=degree in (0, 1]", part));
    }
    group.members.push_back({name_and_degree[0], *degree});
  }
  for (std::vector<double>& row : relations_) row.push_back(0.0);
  groups_.push_back(std::move(group));
  relations_.emplace_back(groups_.size(), 0.0);
  relations_.back().back() = *significance;
  return {};
}

Status SynonymTable::add_relation(const std::vector<std::string>& cells) {
  SEMVIEW_TRY(const std::size_t a, group_index(cells[1]));
  SEMVIEW_TRY(const std::size_t b, group_index(cells[2]));
  const std::optional<double> score = parse_number(cells[3]);
  if (a == b || !score || std::abs(*score) > 1.0) {
    return fail(ErrorCode::kInvalidArgument,
                "expected two different groups and a score in [-1, 1]");
  }
  relations_[a][b] = *score;
  relations_[b][a] = *score;
  return {};
}

Result<SynonymTable> SynonymTable::parse(std::string_view text, std::string_view name) {
  SynonymTable table;
  for (const TextLine& line : content_lines(text)) {
    const std::vector<std::string> cells = split_trimmed(line.text, '\t');
    Status status =
        fail(ErrorCode::kInvalidArgument, "expected 'group' or 'relate' and three cells after it");
    if (cells.size() == 4 && cells[0] == "group") status = table.add_group(cells);
    if (cells.size() == 4 && cells[0] == "relate") status = table.add_relation(cells);
    if (!status) return with_context(std::move(status), fmt::format("{}:{}", name, line.number));
  }
  return table;
}

const SynonymTable& SynonymTable::shipped() {
  static const SynonymTable table = [] {
    Result<SynonymTable> parsed = parse(kSynonyms, "synonyms.tsv");
    SEMVIEW_CHECK(parsed.has_value());
    return *std::move(parsed);
  }();
  return table;
}

bool SynonymTable::contains(std::string_view class_name) const {
  return std::ranges::any_of(groups_, [&](const Group& g) { return g.degree(class_name) > 0.0; });
}

double SynonymTable::significance(std::string_view class_name) const {
  double highest_degree = 0.0;
  double significance = 1.0;
  for (const Group& group : groups_) {
    const double degree = group.degree(class_name);
    if (degree <= highest_degree) continue;
    highest_degree = degree;
    significance = group.significance;
  }
  return significance;
}

double SynonymTable::score(std::string_view a, std::string_view b) const {
  double highest = 0.0;
  double lowest = 0.0;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    const double degree_a = groups_[i].degree(a);
    if (degree_a == 0.0) continue;
    for (std::size_t j = 0; j < groups_.size(); ++j) {
      const double tie = relations_[i][j] * degree_a * groups_[j].degree(b);
      highest = std::max(highest, tie);
      lowest = std::min(lowest, tie);
    }
  }
  return highest > 0.0 ? highest : lowest;
}

double SynonymTable::degree_beside(std::string_view class_name, std::string_view example) const {
  double highest = 0.0;
  for (const Group& group : groups_) {
    if (group.degree(example) == 1.0) highest = std::max(highest, group.degree(class_name));
  }
  return highest;
}

}  // namespace semview::similarity
