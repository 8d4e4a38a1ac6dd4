// SPDX-License-Identifier: Apache-2.0
/// The engine that serves every map: rays against triangles.
#pragma once

#include <memory>

#include "semview/raycast/engine.hpp"
#include "semview/raycast/scene.hpp"

namespace semview::raycast {

/// `render_panorama` and `render_column_view` of a scene.
class EmbreeEngine final : public Engine {
 public:
  static constexpr std::string_view kName = "embree";
  static constexpr std::uint32_t kVersion = 1;

  explicit EmbreeEngine(std::shared_ptr<const Scene> scene);

  std::string_view name() const override { return kName; }
  std::uint32_t version() const override { return kVersion; }
  Panorama panorama(const PanoramaRequest& request) const override;
  ColumnView column_view(const PanoramaRequest& request, bool ranges) const override;

 private:
  std::shared_ptr<const Scene> scene_;
};

}  // namespace semview::raycast
