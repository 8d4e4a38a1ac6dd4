// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/weight_proposal.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace semview::similarity {
namespace {

bool is_called(const NamedClass& named, const std::string& name) {
  return named.name == name || std::ranges::find(named.aliases, name) != named.aliases.end();
}

double weight_of(const NamedClass& observed, const NamedClass& map, const SynonymTable& synonyms) {
  const std::string& map_name = known_name(map, synonyms);
  if (share_a_name(observed, map)) return synonyms.significance(map_name);
  return synonyms.score(known_name(observed, synonyms), map_name);
}

}  // namespace

bool share_a_name(const NamedClass& a, const NamedClass& b) {
  return is_called(a, b.name) || std::ranges::any_of(b.aliases, [&](const std::string& alias) {
           return is_called(a, alias);
         });
}

const std::string& known_name(const NamedClass& named, const SynonymTable& synonyms) {
  if (synonyms.contains(named.name)) return named.name;
  const auto alias = std::ranges::find_if(
      named.aliases, [&](const std::string& name) { return synonyms.contains(name); });
  return alias == named.aliases.end() ? named.name : *alias;
}

Result<WeightProposal> propose_weights(std::span<const NamedClass> observed,
                                       std::span<const NamedClass> map,
                                       const SynonymTable& synonyms) {
  std::vector<NamedClass> columns(map.begin(), map.end());
  columns.push_back({std::string(kNoneColumn)});
  std::vector<NamedClass> rows(observed.begin(), observed.end());
  std::ranges::copy_if(map, std::back_inserter(rows), [&](const NamedClass& named) {
    return std::ranges::find(observed, named.name, &NamedClass::name) == observed.end();
  });
  std::vector<std::string> observed_names;
  std::vector<std::string> map_names;
  observed_names.reserve(rows.size());
  map_names.reserve(columns.size());
  for (const NamedClass& named : rows) observed_names.push_back(named.name);
  for (const NamedClass& named : columns) map_names.push_back(named.name);

  WeightMatrix::Band band;
  std::vector<bool> row_matched(rows.size(), false);
  std::vector<bool> column_matched(columns.size(), false);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      // To thousandths: the file is for people, and 0.8 · 0.2 is not 0.16 in binary.
      const double weight = std::round(weight_of(rows[i], columns[j], synonyms) * 1e3) / 1e3;
      band.weights.push_back(weight);
      if (weight <= 0.0) continue;
      // Seeing nothing tells a class from no other: `none` matches no row.
      if (j < map.size()) row_matched[i] = true;
      if (i < observed.size()) column_matched[j] = true;
    }
  }
  SEMVIEW_TRY(WeightMatrix matrix,
              WeightMatrix::build(std::move(observed_names), std::move(map_names), {band}));
  WeightProposal proposal{std::move(matrix), {}, {}};
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (!row_matched[i]) proposal.unmatched_observed.push_back(observed[i].name);
  }
  for (std::size_t j = 0; j < map.size(); ++j) {
    if (!column_matched[j]) proposal.unmatched_map.push_back(map[j].name);
  }
  return proposal;
}

}  // namespace semview::similarity
