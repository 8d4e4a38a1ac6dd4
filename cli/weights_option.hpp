// SPDX-License-Identifier: Apache-2.0
/// `--weights`: what an observed class speaks for.
#pragma once

#include <string>
#include <string_view>

#include "semview/core/result.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/similarity/weight_matrix.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace semview::cli {

/// In the place of a file: a class of the same name scores 1, every other 0.
inline constexpr std::string_view kIdentityWeights = "identity";

CLI::Option* add_weights_option(CLI::App& verb, std::string& weights);

/// The file, or the identity over these classes.
/// @errors those of `read_weight_matrix`.
Result<similarity::WeightMatrix> read_weights(const std::string& weights,
                                              const ClassTable& observed,
                                              const ClassTable& map);

}  // namespace semview::cli
