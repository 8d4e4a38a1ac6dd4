// SPDX-License-Identifier: Apache-2.0
/// The engine for extruded plans: a walk over the plan a column, no ray in 3D.
#pragma once

#include <memory>

#include "semview/raycast/column_scene.hpp"
#include "semview/raycast/engine.hpp"

namespace semview::raycast {

/// `render_panorama` and `render_column_view` of a column scene.
class ColumnsEngine final : public Engine {
 public:
  static constexpr std::string_view kName = "columns";
  static constexpr std::uint32_t kVersion = 1;

  explicit ColumnsEngine(std::shared_ptr<const ColumnScene> scene);

  std::string_view name() const override { return kName; }
  std::uint32_t version() const override { return kVersion; }
  Panorama panorama(const PanoramaRequest& request) const override;
  ColumnView column_view(const PanoramaRequest& request, bool ranges) const override;

 private:
  std::shared_ptr<const ColumnScene> scene_;
};

}  // namespace semview::raycast
