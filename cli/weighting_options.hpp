// SPDX-License-Identifier: Apache-2.0
/// `--weighting`, `--power` and `--kappa`: from similarity to weight.
#pragma once

#include <string>

#include "semview/observation/similarity_weighting.hpp"

namespace CLI {
class App;
}

namespace semview::cli {

struct WeightingOptions {
  std::string transform = "power";
  double power = observation::SimilarityWeightingConfig{}.power;
  double kappa = observation::SimilarityWeightingConfig{}.kappa;
};

/// `options` must outlive the parse.
void add_weighting_options(CLI::App& verb, WeightingOptions& options);

/// Not checked: `validate` does, and names `power` or `kappa`.
observation::SimilarityWeightingConfig weighting_of(const WeightingOptions& options);

}  // namespace semview::cli
