// SPDX-License-Identifier: Apache-2.0
/// How far two ways to make a panorama see the same. Inside the module only.
#pragma once

#include <cstdint>
#include <string>

#include "semview/core/result.hpp"
#include "semview/raycast/panorama_renderer.hpp"

namespace semview::benchmark::detail {

/// Counts over pairs of panoramas.
class Agreement {
 public:
  void add_labels(const LabelImage& ours, const LabelImage& other);
  void add(const raycast::Panorama& ours, const raycast::Panorama& other);

  double same_share() const {
    return 1.0 - static_cast<double>(different_) / static_cast<double>(pixels_);
  }
  /// "labels: 3 of 259 200 differ; ranges within 0.1 mm".
  std::string text() const;
  /// @errors kInternal: more labels differ than rays that meet an edge exactly explain (one in
  /// 20 000, and never fewer than four are let pass), or a range by more than 1 cm.
  Status check() const;

 private:
  std::int64_t pixels_ = 0;
  std::int64_t different_ = 0;
  std::int64_t ranges_ = 0;
  std::int64_t far_ranges_ = 0;
  double worst_m_ = 0.0;
};

}  // namespace semview::benchmark::detail
