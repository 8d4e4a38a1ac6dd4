// SPDX-License-Identifier: Apache-2.0
#include "trial.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "semview/core/random.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/field/field_likelihood.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/localization/initialization.hpp"
#include "semview/localization/particle_filter.hpp"
#include "semview/localization/pose_estimate.hpp"
#include "semview/observation/voxel_reduction.hpp"
#include "semview/view/depth_observation.hpp"
#include "things.hpp"

namespace semview::paper2023 {
namespace {

constexpr std::size_t kSliceBytes = std::size_t{256} << 20U;

/// Equation (2), to a power.
class FieldModel final : public localization::ObservationModel {
 public:
  FieldModel(const field::FieldLikelihood& likelihood,
             const field::FieldObservation& observation,
             double temper,
             ThreadPool& pool)
      : likelihood_(likelihood), observation_(observation), temper_(temper), pool_(pool) {}

  Result<localization::ObservationWeights> weigh(
      std::span<const localization::Particle> particles) override {
    std::vector<Pose2> poses;
    for (const localization::Particle& particle : particles) {
      poses.push_back(particle.map_from_robot);
    }
    SEMVIEW_TRY(const field::FieldScores scores, likelihood_.score(observation_, poses, pool_));
    localization::ObservationWeights weights;
    for (const std::int64_t loss : scores.losses) {
      weights.log_weights.push_back(-temper_ * static_cast<double>(loss) / field::kUnitsPerNat);
    }
    return weights;
  }

 private:
  const field::FieldLikelihood& likelihood_;
  const field::FieldObservation& observation_;
  double temper_;
  ThreadPool& pool_;
};

/// The flat's cells, by its outline alone.
std::vector<CellIndex> cells_of(const Area& inside) {
  std::vector<CellIndex> cells;
  const auto count = [](double length_m) {
    return static_cast<std::int32_t>(length_m / PoseGrid::kCellSize_m);
  };
  for (std::int32_t y = 0; y < count(inside.max_y_m); ++y) {
    for (std::int32_t x = 0; x < count(inside.max_x_m); ++x) cells.push_back({x, y});
  }
  return cells;
}

localization::ParticleFilter filter_of(const FilterConfig& config,
                                       const std::vector<CellIndex>& cells,
                                       std::uint64_t seed) {
  localization::ParticleFilterConfig filter;
  filter.resample_threshold = 1.0;  // after every image
  Rng start(seed, "start");
  localization::ParticleSet particles =
      localization::uniform_particles(cells, static_cast<std::size_t>(config.particles), start);
  // Without a compass the heading that each was thrown in with is its hypothesis.
  for (localization::Particle& particle : particles) particle.yaw_known = true;
  return {filter,
          std::make_shared<localization::OdometryMotionModel>(config.motion),
          std::move(particles),
          seed};
}

StopRecord record_of(const localization::ParticleFilter& filter,
                     const RecordedFrame& frame,
                     double distance_m,
                     double effective_particles) {
  const Pose2 estimate =
      localization::estimate_pose(filter.particles(), localization::EstimateKind::kWeightedMean)
          .map_from_robot;
  return {distance_m,
          semview::distance_m(estimate, frame.map_from_base),
          std::abs(wrap_angle(estimate.yaw_rad - frame.map_from_base.yaw_rad)),
          effective_particles};
}

Result<VoxelList> reduced(const Recording& recording,
                          const RecordedFrame& frame,
                          LabelSource labels) {
  DepthObservation seen;
  seen.classes = thing_classes();
  seen.depth_m = frame.depth_m;
  seen.labels = labels == LabelSource::kGt ? frame.labels_gt : frame.labels_rcnn;
  seen.camera = recording.camera;
  seen.base_from_camera = recording.base_from_camera;
  return observation::reduce(seen);
}

/// Null where the image holds nothing that the method looks at: no depth, or no named pixel.
Result<std::shared_ptr<const field::FieldObservation>> prepared(
    const Recording& recording,
    const RecordedFrame& frame,
    const Method& method,
    const field::FieldLikelihood& likelihood,
    ThreadPool& pool) {
  if (!measures_anything(frame)) return nullptr;
  SEMVIEW_TRY(const VoxelList voxels, reduced(recording, frame, method.labels));
  const bool named = std::ranges::any_of(
      voxels.voxels, [](const ObservedVoxel& voxel) { return voxel.label != kUnknown; });
  if (method.cue == field::FieldCue::kSem && !named) return nullptr;
  return likelihood.prepare(voxels, pool);
}

}  // namespace

Result<std::vector<std::vector<StopRecord>>> run_trials(
    const Recording& recording,
    const Area& inside,
    const Method& method,
    const FilterConfig& config,
    std::shared_ptr<const field::DistanceField> map,
    const std::vector<std::uint64_t>& seeds) {
  ThreadPool pool(1);  // experiments run several of these at once
  SEMVIEW_TRY(const field::FieldLikelihood likelihood,
              field::FieldLikelihood::make(std::move(map), config.model, kSliceBytes));
  const std::vector<CellIndex> cells = cells_of(inside);
  std::vector<localization::ParticleFilter> filters;
  for (const std::uint64_t seed : seeds) filters.push_back(filter_of(config, cells, seed));
  std::vector<std::vector<StopRecord>> records(seeds.size());
  double driven_m = 0.0;
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    const RecordedFrame& frame = recording.frames[i];
    const RecordedFrame& before = recording.frames[i == 0 ? 0 : i - 1];
    driven_m += distance_m(before.map_from_base, frame.map_from_base);
    SEMVIEW_TRY(const std::shared_ptr<const field::FieldObservation> observation,
                prepared(recording, frame, method, likelihood, pool));
    for (std::size_t run = 0; run < filters.size(); ++run) {
      localization::ParticleFilter& filter = filters[run];
      if (i > 0) filter.predict(inverse(before.odom_from_base) * frame.odom_from_base);
      double effective = static_cast<double>(config.particles);
      if (observation) {
        FieldModel weigher(likelihood, *observation, config.temper, pool);
        SEMVIEW_TRY(const localization::UpdateReport update, filter.update(weigher));
        effective = update.effective_sample_size;
      }
      records[run].push_back(record_of(filter, frame, driven_m, effective));
      if (observation) filter.resample_if_needed();
    }
  }
  return records;
}

}  // namespace semview::paper2023
