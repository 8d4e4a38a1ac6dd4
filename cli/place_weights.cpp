// SPDX-License-Identifier: Apache-2.0
#include "place_weights.hpp"

#include "semview/similarity/plan_likelihood.hpp"
#include "weights_option.hpp"

namespace semview::cli {

Result<similarity::WeightMatrix> place_weights(const std::string& weights,
                                               const ClassTable& observed,
                                               const map::SemanticMap& map) {
  if (!weights.empty()) return read_weights(weights, observed, map.classes);
  similarity::Vocabulary seen;
  for (const std::string& name : observed.names()) seen.push_back({name});
  similarity::Vocabulary drawn;
  for (const map::MapClass& details : map.class_details) {
    drawn.push_back({details.name, details.aliases});
  }
  return similarity::plan_likelihood_weights(seen, drawn);
}

}  // namespace semview::cli
