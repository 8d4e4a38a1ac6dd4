// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/embree_engine.hpp"

#include <utility>

namespace semview::raycast {

EmbreeEngine::EmbreeEngine(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {}

Panorama EmbreeEngine::panorama(const PanoramaRequest& request) const {
  return render_panorama(*scene_, request);
}

ColumnView EmbreeEngine::column_view(const PanoramaRequest& request, bool ranges) const {
  return render_column_view(*scene_, request, ranges);
}

}  // namespace semview::raycast
