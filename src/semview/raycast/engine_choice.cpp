// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/engine_choice.hpp"

#include <fmt/format.h>

#include "semview/core/log.hpp"
#include "semview/raycast/columns_engine.hpp"
#include "semview/raycast/embree_engine.hpp"
#include "semview/raycast/engine_check.hpp"

namespace semview::raycast {
namespace {

std::string describe(const Disagreement& found, const ClassTable& classes) {
  return fmt::format(
      "columns and embree disagree in cell ({}, {}), row {}, column {}: {} at {:.2f} m, {} at "
      "{:.2f} m",
      found.cell.ix,
      found.cell.iy,
      found.row,
      found.column,
      classes.name(found.seen),
      found.seen_range_m,
      classes.name(found.expected),
      found.expected_range_m);
}

}  // namespace

Status check_engine_name(std::string_view name) {
  for (const std::string_view known : {kAutoEngine, ColumnsEngine::kName, EmbreeEngine::kName}) {
    if (name == known) return {};
  }
  return fail(Error{ErrorCode::kInvalidArgument,
                    fmt::format("engine {} is not known: --engine and SEMVIEW_ENGINE take auto, "
                                "columns or embree",
                                name),
                    "--engine"});
}

Result<EngineChoice> choose_engine(std::string_view name,
                                   const EngineMap& map,
                                   const ViewProfile& profile,
                                   ThreadPool& pool) {
  SEMVIEW_TRY_STATUS(check_engine_name(name));
  const auto embree = std::make_shared<const EmbreeEngine>(map.scene);
  if (name == EmbreeEngine::kName) return EngineChoice{embree, "it was asked for"};
  if (map.plan == nullptr) {
    if (name == kAutoEngine) return EngineChoice{embree, "the map is a mesh"};
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("map {}: is a mesh, and engine columns casts plans only; take "
                                  "--engine embree or auto",
                                  map.id),
                      "--engine"});
  }
  const auto columns = std::make_shared<const ColumnsEngine>(
      std::make_shared<const ColumnScene>(ColumnScene::build(*map.plan)));
  if (name == ColumnsEngine::kName) return EngineChoice{columns, "it was asked for"};
  const std::vector<CellIndex> cells = cells_to_check(*map.plan, map.cells);
  if (cells.empty()) {
    return EngineChoice{columns, "the map is a plan; from nowhere can it be compared with embree"};
  }
  const std::optional<Disagreement> found =
      find_disagreement(*columns, *embree, cells, profile, map.ground_height_m, pool);
  if (!found) {
    return EngineChoice{
        columns,
        fmt::format("the map is a plan; embree sees the same from {} cells", cells.size())};
  }
  const std::string disagreement = describe(*found, map.classes);
  log_warning(fmt::format("map {}: {}; embree casts the views", map.id, disagreement));
  return EngineChoice{embree, disagreement};
}

}  // namespace semview::raycast
