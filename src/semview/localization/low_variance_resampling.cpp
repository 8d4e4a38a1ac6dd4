// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/low_variance_resampling.hpp"

#include <numeric>

#include "semview/core/check.hpp"

namespace semview::localization {

std::vector<std::uint32_t> low_variance_sample(std::span<const double> weights,
                                               std::size_t count,
                                               Rng& rng) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  SEMVIEW_CHECK(total > 0.0);
  // The last possible ancestor: rounding in the running sum must not walk past it, or onto an
  // impossible one behind it.
  std::size_t last = weights.size() - 1;
  while (!(weights[last] > 0.0)) --last;

  std::vector<std::uint32_t> ancestors;
  ancestors.reserve(count);
  const double step = total / static_cast<double>(count);
  const double first = rng.uniform() * step;
  std::size_t i = 0;
  double reached = weights[0];
  for (std::size_t k = 0; k < count; ++k) {
    const double mark = first + static_cast<double>(k) * step;
    while (mark >= reached && i < last) reached += weights[++i];
    ancestors.push_back(static_cast<std::uint32_t>(i));
  }
  return ancestors;
}

}  // namespace semview::localization
