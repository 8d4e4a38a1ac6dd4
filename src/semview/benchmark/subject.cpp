// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/subject.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "semview/benchmark/interleave.hpp"
#include "semview/core/random.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/raycast/column_renderer.hpp"
#include "semview/raycast/mesh_cell_grid.hpp"

namespace semview::benchmark {
namespace {

Result<std::shared_ptr<Subject>> prepare(std::string name, map::SemanticMap map) {
  auto subject = std::make_shared<Subject>();
  subject->name = std::move(name);
  subject->map = std::make_shared<const map::SemanticMap>(std::move(map));
  const map::ColumnMap* columns = subject->map->columns();
  subject->mesh_s = seconds_of([&] {
    subject->mesh = columns != nullptr ? map::extrude(*columns) : subject->map->mesh()->mesh;
  });
  auto built = Result<raycast::Scene>(tl::unexpect, Error{});
  subject->scene_s = seconds_of([&] { built = raycast::Scene::build(subject->mesh); });
  if (!built) return with_context(std::move(built), subject->name);
  SEMVIEW_TRY(raycast::Scene scene, std::move(built));
  subject->scene = std::make_shared<const raycast::Scene>(std::move(scene));
  if (columns != nullptr) {
    subject->columns_s = seconds_of([&] {
      subject->columns =
          std::make_shared<const raycast::ColumnScene>(raycast::ColumnScene::build(*columns));
    });
    subject->cells = map::build_cell_grid(*columns, kEyeHeight_m);
  } else {
    SEMVIEW_TRY(
        subject->cells,
        raycast::build_cell_grid(*subject->scene, subject->map->ground_height_m, kEyeHeight_m));
  }
  if (subject->sample(1).empty()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: no free cell to look from", subject->name));
  }
  return subject;
}

}  // namespace

std::vector<CellIndex> Subject::sample(std::size_t count) const {
  std::vector<CellIndex> free = cells.free_cells();
  std::erase_if(free, [this](const CellIndex& cell) { return !cells.has_eye(cell); });
  Rng rng(1, "benchmark cells");
  count = std::min(count, free.size());
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(free[i], free[i + rng.below(free.size() - i)]);
  }
  free.resize(count);
  return free;
}

ColumnView Subject::runs(const raycast::PanoramaRequest& request) const {
  return columns != nullptr ? raycast::render_column_view(*columns, request, false)
                            : raycast::render_column_view(*scene, request);
}

raycast::PanoramaRequest Subject::request(const CellIndex& cell,
                                          const PanoramaCamera& camera) const {
  raycast::PanoramaRequest request;
  request.map_from_robot = PoseGrid::center(cell);
  request.eye_z_m = eye_z_m();
  request.camera = camera;
  return request;
}

Result<std::shared_ptr<const Subject>> prepare_subject(std::string name, map::SemanticMap map) {
  SEMVIEW_TRY(std::shared_ptr<const Subject> subject, prepare(std::move(name), std::move(map)));
  return subject;
}

Result<std::shared_ptr<const Subject>> prepare_subject(std::string name, const OfficePlan& office) {
  SEMVIEW_TRY(map::SemanticMap map, draw_office(office));
  SEMVIEW_TRY(const std::shared_ptr<Subject> subject, prepare(std::move(name), std::move(map)));
  subject->office = office;
  return std::shared_ptr<const Subject>(subject);
}

PanoramaCamera camera_of(int columns) {
  PanoramaCamera camera;
  camera.columns = columns;
  camera.rows = columns / 4;
  return camera;
}

}  // namespace semview::benchmark
