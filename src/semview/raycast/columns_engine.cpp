// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/columns_engine.hpp"

#include <utility>

#include "semview/raycast/column_renderer.hpp"

namespace semview::raycast {

ColumnsEngine::ColumnsEngine(std::shared_ptr<const ColumnScene> scene) : scene_(std::move(scene)) {}

Panorama ColumnsEngine::panorama(const PanoramaRequest& request) const {
  return render_panorama(*scene_, request);
}

ColumnView ColumnsEngine::column_view(const PanoramaRequest& request, bool ranges) const {
  return render_column_view(*scene_, request, ranges);
}

}  // namespace semview::raycast
