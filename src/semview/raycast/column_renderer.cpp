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
  RunCollection runs;
};

Workspace& workspace_for(const PanoramaCamera& camera) {
  static thread_local Workspace workspace;
  if (!workspace.camera || workspace.camera->camera() != camera) workspace.camera.emplace(camera);
  return workspace;
}

}  // namespace

ColumnView render_column_view(const ColumnScene& scene,
                              const PanoramaRequest& request,
                              bool ranges) {
  Workspace& work = workspace_for(request.camera);
  work.camera->aim(scene, request, work.rays);
  walk_columns(scene.grid(), work.rays, work.crossings);
  ColumnPainter(scene.plan(), request.eye_z_m, ranges)
      .paint(work.crossings, work.camera->rows(), work.runs);
  const auto count = static_cast<std::ptrdiff_t>(work.runs.first_run.back());
  const std::vector<RunPlane>& planes = work.runs.planes;
  return ColumnView::from_canonical_runs(request.camera.rows,
                                         work.runs.first_run,
                                         {work.runs.runs.begin(), work.runs.runs.begin() + count},
                                         {planes.begin(), planes.begin() + (ranges ? count : 0)});
}

Panorama render_panorama(const ColumnScene& scene, const PanoramaRequest& request) {
  const ColumnView view = render_column_view(scene, request, true);
  return {view.to_labels(), view.to_ranges(request.camera)};
}

}  // namespace semview::raycast
