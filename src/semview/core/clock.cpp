// SPDX-License-Identifier: Apache-2.0
#include "semview/core/clock.hpp"

namespace semview {
namespace {

class SteadyClock final : public Clock {
 public:
  TimePoint now() const override { return std::chrono::steady_clock::now(); }
};

}  // namespace

const Clock& steady_clock() {
  static const SteadyClock clock;
  return clock;
}

}  // namespace semview
