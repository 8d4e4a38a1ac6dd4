// SPDX-License-Identifier: Apache-2.0
#include "semview/core/random.hpp"

#include <bit>
#include <cmath>
#include <numbers>
#include <span>

#include "semview/core/hash.hpp"

namespace semview {
namespace {

// SplitMix64 (Steele, Lea, Flood 2014): the seeding that xoshiro's authors recommend.
std::uint64_t split_mix(std::uint64_t& state) {
  state += 0x9e3779b97f4a7c15U;
  std::uint64_t z = state;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

}  // namespace

Rng::Rng(std::uint64_t seed, std::string_view stream, std::uint64_t index) {
  std::uint64_t mixed = seed;
  mixed = split_mix(mixed) ^ hash64(std::as_bytes(std::span(stream)));
  mixed = split_mix(mixed) ^ index;
  for (std::uint64_t& word : state_) word = split_mix(mixed);
}

// xoshiro256++ 1.0 (Blackman, Vigna 2019).
std::uint64_t Rng::next_u64() {
  const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
  const std::uint64_t shifted = state_[1] << 17U;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double Rng::uniform() { return static_cast<double>(next_u64() >> 11U) * 0x1.0p-53; }

double Rng::uniform(double low, double high) { return low + (high - low) * uniform(); }

std::uint64_t Rng::below(std::uint64_t count) {
  // Rejecting the incomplete last block keeps every value equally likely.
  const std::uint64_t limit = UINT64_MAX - UINT64_MAX % count;
  std::uint64_t value = next_u64();
  while (value >= limit) value = next_u64();
  return value % count;
}

double Rng::normal(double mean, double sigma) {
  // Box-Muller without a kept second value: a stream's position is then a function of its calls.
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return mean + sigma * radius * std::cos(2.0 * std::numbers::pi * uniform());
}

}  // namespace semview
