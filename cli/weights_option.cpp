// SPDX-License-Identifier: Apache-2.0
#include "weights_option.hpp"

#include <CLI/CLI.hpp>

namespace semview::cli {

CLI::Option* add_weights_option(CLI::App& verb, std::string& weights) {
  return verb
      .add_option("--weights",
                  weights,
                  "Weight matrix, or `identity`: a class of the same name scores 1, every other 0")
      ->type_name("FILE.csv|identity");
}

Result<similarity::WeightMatrix> read_weights(const std::string& weights,
                                              const ClassTable& observed,
                                              const ClassTable& map) {
  if (weights == kIdentityWeights) return similarity::WeightMatrix::identity(observed, map);
  return similarity::read_weight_matrix(weights);
}

}  // namespace semview::cli
