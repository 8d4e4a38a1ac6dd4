// SPDX-License-Identifier: Apache-2.0
#include "flat_map.hpp"

#include <utility>

#include "semview/field/fusion.hpp"
#include "things.hpp"

namespace semview::paper2023 {

Result<field::SemanticVolume> fuse_survey(const Recording& survey,
                                          LabelSource labels,
                                          ThreadPool& pool) {
  field::SemanticVolume volume(field::VolumeShape{}, thing_classes());
  for (const RecordedFrame& recorded : survey.frames) {
    // Too near to a wall the camera measures nothing.
    if (!measures_anything(recorded)) continue;
    field::DepthFrame frame;
    frame.depth_m = recorded.depth_m;
    frame.labels = labels == LabelSource::kGt ? recorded.labels_gt : recorded.labels_rcnn;
    frame.camera = survey.camera;
    frame.map_from_camera = recorded.map_from_camera;
    SEMVIEW_TRY([[maybe_unused]] const field::FusedFrame fused,
                field::fuse(frame, field::FusionConfig{}, pool, volume));
  }
  return volume;
}

Result<std::shared_ptr<const field::DistanceField>> map_of(const Recording& survey,
                                                           LabelSource labels,
                                                           ThreadPool& pool) {
  SEMVIEW_TRY(const field::SemanticVolume volume, fuse_survey(survey, labels, pool));
  constexpr double kGround_m = 0.0;
  SEMVIEW_TRY(std::unique_ptr<field::DistanceField> distances,
              field::distances_of_volume(volume, kGround_m, field::SurfaceReach::kEverywhere));
  return std::shared_ptr<const field::DistanceField>(std::move(distances));
}

}  // namespace semview::paper2023
