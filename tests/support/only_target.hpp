// SPDX-License-Identifier: Apache-2.0
/// Forces one set of vector instructions, to compare what they compute. Link PkgConfig::hwy.
#pragma once

#include <cstdint>

#include <hwy/targets.h>

namespace semview {

/// What Highway dispatches runs on one target as long as this lives; see
/// `hwy::SupportedAndGeneratedTargets()`.
class OnlyTarget {
 public:
  explicit OnlyTarget(std::int64_t target) { force(target); }
  ~OnlyTarget() { force(0); }
  OnlyTarget(const OnlyTarget&) = delete;
  OnlyTarget& operator=(const OnlyTarget&) = delete;

 private:
  static void force(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

}  // namespace semview
