// SPDX-License-Identifier: Apache-2.0
/// Which weights a single picture is compared with.
#pragma once

#include <string>

#include "semview/core/result.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/similarity/weight_matrix.hpp"

namespace semview::cli {

/// The matrix of --weights or, where none is given, likelihood ratios from the names of the classes
/// (`similarity::plan_likelihood_weights`).
/// @errors those of `read_weights`.
Result<similarity::WeightMatrix> place_weights(const std::string& weights,
                                               const ClassTable& observed,
                                               const map::SemanticMap& map);

}  // namespace semview::cli
