// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/pixel_scorer.hpp"

#include <algorithm>
#include <string_view>

namespace semview::benchmark {

template <typename Weight>
PixelWeights<Weight>::PixelWeights(const similarity::WeightMatrix& weights,
                                   const ClassTable& observed,
                                   const ClassTable& map,
                                   double scale) {
  const auto index = [](const auto& names, std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  for (int o = 1; o <= observed.size(); ++o) {
    const std::size_t row = index(weights.observed_names(), observed.name(static_cast<ClassId>(o)));
    for (int m = 0; m <= map.size(); ++m) {
      const std::string_view name =
          m == 0 ? similarity::kNoneColumn : map.name(static_cast<ClassId>(m));
      const double weight = weights.weight(0, row, index(weights.map_names(), name)) * scale;
      values_[static_cast<std::size_t>(o) * 256 + static_cast<std::size_t>(m)] =
          static_cast<Weight>(std::is_integral_v<Weight> ? std::round(weight) : weight);
    }
  }
}

template class PixelWeights<float>;
template class PixelWeights<std::int32_t>;

}  // namespace semview::benchmark
