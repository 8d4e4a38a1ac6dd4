// SPDX-License-Identifier: Apache-2.0
#include "weighting_options.hpp"

#include <CLI/CLI.hpp>

namespace semview::cli {

void add_weighting_options(CLI::App& verb, WeightingOptions& options) {
  verb.add_option("--weighting",
                  options.transform,
                  "Weight from similarity: `power` (s^p) or `exponential` (e^(kappa s))")
      ->check(CLI::IsMember({"power", "exponential"}))
      ->capture_default_str();
  verb.add_option("--power", options.power, "p of --weighting power")->capture_default_str();
  verb.add_option("--kappa", options.kappa, "kappa of --weighting exponential")
      ->capture_default_str();
}

observation::SimilarityWeightingConfig weighting_of(const WeightingOptions& options) {
  observation::SimilarityWeightingConfig config;
  config.transform = options.transform == "power" ? observation::WeightTransform::kPower
                                                  : observation::WeightTransform::kExponential;
  config.power = options.power;
  config.kappa = options.kappa;
  return config;
}

}  // namespace semview::cli
