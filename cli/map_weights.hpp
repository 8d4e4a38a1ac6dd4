// SPDX-License-Identifier: Apache-2.0
/// The weights that a map is scored with when nobody or somebody says which.
#pragma once

#include <string>

#include "semview/core/result.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/similarity/weight_matrix.hpp"

namespace semview::cli {

struct ChosenWeights {
  similarity::WeightMatrix matrix;
  std::string name;  ///< for people
};

/// Those of --weights; else the map's own if they fit the observer's classes; else, with a warning,
/// the identity where every observed class is one of the map's.
/// @param weights  as of `read_weights`; may be empty
/// @param map_name  for messages
/// @param shipped_csv  the map's own matrix, empty if it has none
/// @errors kInvalidArgument: weights are needed, or do not fit; those of `read_weights`.
Result<ChosenWeights> choose_weights(const std::string& weights,
                                     const std::string& map_name,
                                     const std::string& shipped_csv,
                                     const ClassTable& observed,
                                     const ClassTable& map);

}  // namespace semview::cli
