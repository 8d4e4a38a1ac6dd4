// SPDX-License-Identifier: Apache-2.0
/// Seeded random streams with the same numbers on every machine and standard library.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace semview {

/// A xoshiro256++ generator. Each purpose takes a stream of its own from one seed, so that drawing
/// more numbers for one purpose changes no other: `Rng(seed, "odometry")`.
class Rng {
 public:
  explicit Rng(std::uint64_t seed, std::string_view stream = {}, std::uint64_t index = 0);

  std::uint64_t next_u64();
  /// Uniform in [0, 1).
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high);
  /// Uniform in [0, count); `count` > 0.
  std::uint64_t below(std::uint64_t count);
  /// Standard normal times `sigma`, plus `mean`; `sigma` >= 0.
  double normal(double mean, double sigma);

 private:
  std::array<std::uint64_t, 4> state_{};
};

}  // namespace semview
