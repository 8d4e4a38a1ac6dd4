// SPDX-License-Identifier: Apache-2.0
/// A first weight matrix for a map and a vocabulary, made from names.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/similarity/synonym_table.hpp"
#include "semview/similarity/vocabulary.hpp"
#include "semview/similarity/weight_matrix.hpp"

namespace semview::similarity {

/// The name by which the table knows a class: its own, else the first known alias, else its own.
const std::string& known_name(const NamedClass& named, const SynonymTable& synonyms);

/// True if a name or alias of one is one of the other's.
bool share_a_name(const NamedClass& a, const NamedClass& b);

struct WeightProposal {
  WeightMatrix matrix;
  /// Classes of the vocabulary that speak for none of the map's: these say nothing yet, and want a
  /// look.
  std::vector<std::string> unmatched_observed;
  /// Classes of the map that none of the vocabulary's speaks for.
  std::vector<std::string> unmatched_map;
};

/// Rows are the classes of the vocabulary, `observed`, and after them those of the map whose names
/// it does not have: a simulated robot, or a network trained for the building, names what it sees
/// as the map does. Columns are the map's classes and `none`. Two classes of one name, or
/// of which one's name or alias is one of the other's, match in full: with their significance,
/// which is 1 unless the table has another. Otherwise the table's score of any of their names
/// counts.
/// @errors kInvalidArgument: names that a weight matrix does not take.
Result<WeightProposal> propose_weights(std::span<const NamedClass> observed,
                                       std::span<const NamedClass> map,
                                       const SynonymTable& synonyms = SynonymTable::shipped());

}  // namespace semview::similarity
