// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/column_renderer.hpp"

#include <optional>
#include <vector>

#include "semview/raycast/column_camera.hpp"
#include "semview/raycast/column_painter.hpp"

namespace semview::raycast {
namespace {

/// Memory of a thread that is kept from view to view, and what it last knew of a camera.
struct Workspace {
  std::optional<ColumnCamera> camera;
  ColumnRays rays;
  Crossings crossings;
  RowMosaic mosaic;
  std::vector<Run> runs;
  std::vector<RunPlane> planes;
};

Workspace& workspace_for(const PanoramaCamera& camera) {
  static thread_local Workspace workspace;
  if (!workspace.camera || workspace.camera->camera() != camera) workspace.camera.emplace(camera);
  workspace.runs.clear();
  workspace.planes.clear();
  return workspace;
}

}  // namespace

ColumnView render_column_view(const ColumnScene& scene,
                              const PanoramaRequest& request,
                              bool ranges) {
  Workspace& work = workspace_for(request.camera);
  work.camera->aim(scene, request, work.rays);
  walk_columns(scene.grid(), work.rays, work.crossings);
  const ColumnPainter painter(scene.plan(), request.eye_z_m, ranges);
  std::vector<std::uint32_t> first_run{0};
  first_run.reserve(work.rays.count + 1);
  for (std::size_t c = 0; c < work.rays.count; ++c) {
    const std::uint32_t first = work.crossings.first[c];
    const std::uint32_t end = work.crossings.first[c + 1];
    painter.paint(std::span(work.crossings.all).subspan(first, end - first),
                  work.camera->rows(),
                  work.mosaic,
                  work.runs,
                  work.planes);
    first_run.push_back(static_cast<std::uint32_t>(work.runs.size()));
  }
  return *ColumnView::from_runs(request.camera.rows,
                                std::move(first_run),
                                std::vector<Run>(work.runs),
                                std::vector<RunPlane>(work.planes));
}

Panorama render_panorama(const ColumnScene& scene, const PanoramaRequest& request) {
  const ColumnView view = render_column_view(scene, request, true);
  return {view.to_labels(), view.to_ranges(request.camera)};
}

}  // namespace semview::raycast
