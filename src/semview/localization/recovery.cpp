// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/recovery.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace semview::localization {

Status validate(const RecoveryConfig& config) {
  const auto wrong = [](const char* field, double value, const char* expected) {
    return Status(fail(Error{ErrorCode::kInvalidArgument,
                             fmt::format("{} is {}: expected {}", field, value, expected),
                             field}));
  };
  if (!(config.recovery_alpha_slow > 0.0 && config.recovery_alpha_slow < 1.0)) {
    return wrong("recovery_alpha_slow", config.recovery_alpha_slow, "above 0, below 1");
  }
  if (!(config.recovery_alpha_fast > config.recovery_alpha_slow &&
        config.recovery_alpha_fast <= 1.0)) {
    return wrong(
        "recovery_alpha_fast", config.recovery_alpha_fast, "above recovery_alpha_slow, at most 1");
  }
  if (!(config.most_share > 0.0 && config.most_share <= 1.0)) {
    return wrong("most_share", config.most_share, "above 0, at most 1");
  }
  return {};
}

double RecoveryMonitor::share_to_replace(double average) {
  if (!(average >= 0.0) || !std::isfinite(average)) return 0.0;
  if (slow_ == 0.0) {
    slow_ = fast_ = average;
    return 0.0;
  }
  slow_ += config_.recovery_alpha_slow * (average - slow_);
  fast_ += config_.recovery_alpha_fast * (average - fast_);
  if (fast_ >= slow_) return 0.0;
  return std::min(config_.most_share, 1.0 - fast_ / slow_);
}

}  // namespace semview::localization
