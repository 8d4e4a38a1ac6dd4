// SPDX-License-Identifier: Apache-2.0
/// How far two ways to make a panorama see the same. Inside the module only.
#pragma once

#include <cstdint>
#include <string>

#include "semview/core/result.hpp"
#include "semview/raycast/panorama_renderer.hpp"

namespace semview::benchmark::detail {

/// What may differ: rays that meet an edge exactly see either side of it.
inline constexpr double kTiesOfEngines = 1e-6;  ///< columns and Embree: what columns are held to
inline constexpr double kTiesOfPeers = 5e-5;    ///< others make rays and scenes in their own way
inline constexpr std::int64_t kFewTies = 4;     ///< always let pass: small pictures have edges too

/// Counts over pairs of panoramas.
class Agreement {
 public:
  /// @param ties  The share of pixels that may differ.
  explicit Agreement(double ties) : ties_(ties) {}

  void add_labels(const LabelImage& ours, const LabelImage& other);
  /// Labels, and ranges if both have them.
  void add(const raycast::Panorama& ours, const raycast::Panorama& other);

  double same_share() const {
    return 1.0 - static_cast<double>(different_) / static_cast<double>(pixels_);
  }
  /// "3 of 259200 labels differ, ranges within 0.1 mm"; without the ranges if none was compared.
  std::string text() const;
  /// @errors kInternal: more labels differ than `ties` and `kFewTies` let pass, or as many ranges
  /// by more than 1 cm.
  Status check() const;

 private:
  double ties_;
  std::int64_t pixels_ = 0;
  std::int64_t different_ = 0;
  std::int64_t ranges_ = 0;
  std::int64_t far_ranges_ = 0;
  double worst_m_ = 0.0;
};

}  // namespace semview::benchmark::detail
