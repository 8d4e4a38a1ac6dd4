// SPDX-License-Identifier: Apache-2.0
/// Time as a parameter, so that tests need not wait.
#pragma once

#include <atomic>
#include <chrono>

namespace semview {

using TimePoint = std::chrono::steady_clock::time_point;
using Duration = std::chrono::steady_clock::duration;

/// Where code that has deadlines or measures gets its time. @threads safe
class Clock {
 public:
  virtual ~Clock() = default;
  virtual TimePoint now() const = 0;
};

/// The machine's monotonic clock; one for the whole program.
const Clock& steady_clock();

/// A clock that moves only when told to.
class ManualClock final : public Clock {
 public:
  TimePoint now() const override { return TimePoint(Duration(ticks_.load())); }
  void advance(Duration step) { ticks_ += step.count(); }

 private:
  std::atomic<Duration::rep> ticks_{0};
};

}  // namespace semview
