// SPDX-License-Identifier: Apache-2.0
/// Waiting for what another thread or process brings about.
#pragma once

#include <chrono>
#include <thread>

namespace semview::testing {

/// Longer than anything takes on a busy machine; reached only when a test fails.
inline constexpr std::chrono::seconds kPatience{60};

/// True as soon as `condition` holds; false if it does not while `patience` lasts.
template <typename Condition>
bool eventually(const Condition& condition, std::chrono::milliseconds patience = kPatience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

}  // namespace semview::testing
