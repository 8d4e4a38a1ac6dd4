// SPDX-License-Identifier: Apache-2.0
#include "semview/field/map_distances.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "semview/field/vdb_file.hpp"

namespace semview::field {
namespace {

FieldCue cue_of(ScoreModel model) {
  if (model == ScoreModel::kSdf) return FieldCue::kSdf;
  return model == ScoreModel::kSem ? FieldCue::kSem : FieldCue::kSdfSem;
}

}  // namespace

Result<std::shared_ptr<const DistanceField>> distances_of_map(const map::SemanticMap& map) {
  if (!map.volume.empty()) {
    SEMVIEW_TRY(const StoredVolume stored, read_vdb(map.volume));
    return distances_of_volume(stored.volume, map.ground_height_m, SurfaceReach::kEverywhere);
  }
  if (const map::ColumnMap* plan = map.columns()) return distances_of_plan(*plan, map.classes);
  return fail(ErrorCode::kFailedPrecondition,
              fmt::format("map {} is a mesh without a volume; depth is scored on plans and on what "
                          "`semview fuse` makes",
                          map.id));
}

FieldModelConfig field_model(const DepthScoring& scoring,
                             const map::SemanticMap& map,
                             const ClassTable& classes) {
  FieldModelConfig config;
  config.cue = cue_of(scoring.model);
  config.z_sdf = scoring.z_sdf;
  config.z_sem = 1.0 - scoring.z_sdf;
  config.sigma_sdf_m = scoring.sigma_sdf_m;
  config.sigma_sem_m = scoring.sigma_sem_m;
  if (!scoring.by_movable) return config;
  for (const std::string_view name : classes.names()) {
    const auto found = std::ranges::find(map.class_details, name, &map::MapClass::name);
    config.movable.push_back(found == map.class_details.end() ? 0.0 : found->movable);
  }
  return config;
}

}  // namespace semview::field
