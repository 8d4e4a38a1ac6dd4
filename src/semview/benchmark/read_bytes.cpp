// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/read_bytes.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "semview/benchmark/read_bytes.cpp"
#include <hwy/foreach_target.h>  // compiles what follows once a target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace semview::benchmark::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

HWY_ATTR std::uint64_t read_words(const std::uint64_t* memory, std::size_t count) {
  const hn::ScalableTag<std::uint64_t> tag;
  const std::size_t lanes = hn::Lanes(tag);
  auto a = hn::Zero(tag);
  auto b = hn::Zero(tag);
  auto c = hn::Zero(tag);
  auto d = hn::Zero(tag);
  for (std::size_t i = 0; i + 4 * lanes <= count; i += 4 * lanes) {
    a = hn::Xor(a, hn::Load(tag, memory + i));
    b = hn::Xor(b, hn::Load(tag, memory + i + lanes));
    c = hn::Xor(c, hn::Load(tag, memory + i + 2 * lanes));
    d = hn::Xor(d, hn::Load(tag, memory + i + 3 * lanes));
  }
  return hn::GetLane(hn::Xor(hn::Xor(a, b), hn::Xor(c, d)));
}

}  // namespace semview::benchmark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace semview::benchmark {

HWY_EXPORT(read_words);

std::uint64_t read_bytes(std::span<const std::uint64_t> memory, std::size_t bytes) {
  std::uint64_t sum = 0;
  for (std::size_t left = bytes / sizeof(std::uint64_t); left > 0;) {
    const std::size_t count = std::min(left, memory.size());
    sum += HWY_DYNAMIC_DISPATCH(read_words)(memory.data(), count);
    left -= count;
  }
  return sum;
}

}  // namespace semview::benchmark
#endif  // HWY_ONCE
