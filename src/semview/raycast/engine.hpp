// SPDX-License-Identifier: Apache-2.0
/// What casts panoramas, whichever way.
#pragma once

#include <cstdint>
#include <string_view>

#include "semview/raycast/panorama_renderer.hpp"
#include "semview/view/column_view.hpp"

namespace semview::raycast {

/// Casts panoramas of one map.
///
/// Engines may differ in how they look at a map and not in what they see of it: labels are equal
/// but for pixels whose ray passes within a hair of an edge, ranges within a centimetre. An engine
/// gives equal views for equal requests always.
/// Requests must pass `validate(const PanoramaRequest&)`.
/// @threads Const members may be called from several threads at once.
class Engine {
 public:
  virtual ~Engine() = default;

  /// Name and version in cache keys. The version is raised only when the views of
  /// tests/raycast/golden_views_test.cpp change.
  virtual std::string_view name() const = 0;
  virtual std::uint32_t version() const = 0;

  virtual Panorama panorama(const PanoramaRequest& request) const = 0;
  /// The labels of `panorama` as runs; with `ranges` each run carries its plane, and the ranges
  /// that `ColumnView::to_ranges` rebuilds are within 1 mm of those of `panorama`.
  virtual ColumnView column_view(const PanoramaRequest& request, bool ranges) const = 0;
};

}  // namespace semview::raycast
