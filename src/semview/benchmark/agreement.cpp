// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

namespace semview::benchmark::detail {

constexpr double kFarRange_m = 0.01;

void Agreement::add_labels(const LabelImage& ours, const LabelImage& other) {
  pixels_ += static_cast<std::int64_t>(ours.pixels().size());
  for (std::size_t i = 0; i < ours.pixels().size(); ++i) {
    if (ours.pixels()[i] != other.pixels()[i]) ++different_;
  }
}

void Agreement::add(const raycast::Panorama& ours, const raycast::Panorama& other) {
  add_labels(ours.labels, other.labels);
  if (ours.ranges_m.pixels().empty() || other.ranges_m.pixels().empty()) return;
  for (std::size_t i = 0; i < ours.labels.pixels().size(); ++i) {
    // A pixel on an edge belongs to either of two surfaces.
    if (ours.labels.pixels()[i] != other.labels.pixels()[i]) continue;
    const float our_range = ours.ranges_m.pixels()[i];
    const float other_range = other.ranges_m.pixels()[i];
    if (std::isinf(our_range) && std::isinf(other_range)) continue;
    const double apart_m = std::abs(static_cast<double>(our_range) - other_range);
    ++ranges_;
    if (!(apart_m <= kFarRange_m)) {
      ++far_ranges_;
    } else {
      worst_m_ = std::max(worst_m_, apart_m);
    }
  }
}

std::string Agreement::text() const {
  std::string text = different_ == 0 ? fmt::format("{} labels equal", pixels_)
                                     : fmt::format("{} of {} labels differ", different_, pixels_);
  if (ranges_ > 0) text += fmt::format(", ranges within {:.2g} mm", 1e3 * worst_m_);
  if (far_ranges_ > 0) text += fmt::format(" but for {}", far_ranges_);
  return text;
}

Status Agreement::check() const {
  const std::int64_t allowed =
      std::max(kFewTies, static_cast<std::int64_t>(ties_ * static_cast<double>(pixels_)));
  if (different_ <= allowed && far_ranges_ <= allowed) return {};
  return fail(ErrorCode::kInternal, "results differ: " + text());
}

}  // namespace semview::benchmark::detail
