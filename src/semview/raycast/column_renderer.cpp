// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/column_renderer.hpp"

#include <limits>
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

/// Leaves the runs in the workspace.
Workspace& cast(const ColumnScene& scene, const PanoramaRequest& request, bool ranges) {
  Workspace& work = workspace_for(request.camera);
  work.camera->aim(scene, request, work.rays);
  walk_columns(scene.grid(), work.rays, work.crossings);
  ColumnPainter(scene.plan(), request.eye_z_m, ranges)
      .paint(work.crossings, work.camera->rows(), work.runs);
  return work;
}

/// What `ColumnView::to_ranges` computes for planes in general. A caster's are upright or level, so
/// that a multiplication a pixel is enough.
struct RangeOfRows {
  float scale_m = std::numeric_limits<float>::infinity();
  const float* range_per_m;

  RangeOfRows(const RunPlane& plane, const ColumnCamera& camera)
      : range_per_m(camera.secants().data()) {
    if (plane.a_per_m != 0.0F) scale_m = 1.0F / plane.a_per_m;
    if (plane.b_per_m == 0.0F) return;
    scale_m = 1.0F / plane.b_per_m;
    range_per_m = camera.cosecants().data();
  }
};

}  // namespace

ColumnView render_column_view(const ColumnScene& scene,
                              const PanoramaRequest& request,
                              bool ranges) {
  const RunCollection& found = cast(scene, request, ranges).runs;
  const auto count = static_cast<std::ptrdiff_t>(found.first_run.back());
  return ColumnView::from_canonical_runs(
      request.camera.rows,
      found.first_run,
      {found.runs.begin(), found.runs.begin() + count},
      {found.planes.begin(), found.planes.begin() + (ranges ? count : 0)});
}

Panorama render_panorama(const ColumnScene& scene, const PanoramaRequest& request) {
  const Workspace& work = cast(scene, request, true);
  const int rows = request.camera.rows;
  const auto columns = static_cast<std::size_t>(request.camera.columns);
  Panorama panorama{LabelImage(rows, request.camera.columns),
                    RangeImage(rows, request.camera.columns)};
  for (std::size_t c = 0; c < columns; ++c) {
    ClassId* label = panorama.labels.row(0).data() + c;
    float* range_m = panorama.ranges_m.row(0).data() + c;
    std::size_t row = 0;
    for (std::size_t i = work.runs.first_run[c]; i < work.runs.first_run[c + 1]; ++i) {
      const Run run = work.runs.runs[i];
      const RangeOfRows range(work.runs.planes[i], *work.camera);
      for (; row < run.end_row; ++row, label += columns, range_m += columns) {
        *label = run.label;
        *range_m = range.scale_m * range.range_per_m[row];
      }
    }
  }
  return panorama;
}

}  // namespace semview::raycast
