// SPDX-License-Identifier: Apache-2.0
#include "trial.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "raw_classes.hpp"
#include "semview/core/random.hpp"
#include "semview/localization/initialization.hpp"
#include "semview/localization/particle_filter.hpp"
#include "semview/localization/recovery.hpp"
#include "semview/map/distortion.hpp"
#include "semview/observation/nearby_scores.hpp"
#include "semview/observation/score_source_observation_model.hpp"
#include "semview/similarity/similarity_score_source.hpp"
#include "semview/view/observation_resampler.hpp"

namespace semview::paper2017 {
namespace {

using localization::Particle;
using localization::ParticleSet;

ParticleSet first_particles(const RowWorld& world, const Method& method, Start start, Rng& rng) {
  ParticleSet particles =
      start == Start::kGlobal
          ? localization::uniform_particles(world.free_cells, kGlobalParticles, rng)
          : localization::gaussian_particles(world.truth.front(),
                                             method.start_sigma_m,
                                             method.start_heading_sigma_rad,
                                             kLocalParticles,
                                             rng);
  if (method.affine) localization::spread_affines(particles, *method.affine, rng);
  return particles;
}

void set_estimate(StopRecord& record, const Pose2& estimate, const Pose2& truth) {
  record.map_from_robot = estimate;
  record.estimate_m = distance_m(estimate, truth);
  record.heading_rad = std::abs(wrap_angle(estimate.yaw_rad - truth.yaw_rad));
}

StopRecord measure(const ParticleSet& particles, const Method& method, const Pose2& truth) {
  StopRecord record;
  record.min_m = INFINITY;
  for (const Particle& particle : particles) {
    const double error_m = distance_m(particle.map_from_robot, truth);
    record.weighted_mean_m += particle.weight * error_m;
    record.mean_m += error_m / static_cast<double>(particles.size());
    record.min_m = std::min(record.min_m, error_m);
  }
  record.best_m =
      distance_m(localization::estimate_pose(particles, localization::EstimateKind::kHighestWeight)
                     .map_from_robot,
                 truth);
  set_estimate(
      record, localization::estimate_pose(particles, method.estimate).map_from_robot, truth);
  record.affine = localization::estimate_affine(particles).mean;
  record.particles = particles.size();
  record.effective_sample_size = localization::effective_sample_size(particles);
  return record;
}

localization::ParticleFilterConfig filter_config(const Method& method) {
  localization::ParticleFilterConfig config;
  config.resample_threshold = 1.0;
  config.compass.gain = method.compass_gain;
  config.compass.gate_rad = kPi;
  config.kld = method.kld;
  config.affine = method.affine;
  return config;
}

/// One drive through a world.
class Trial {
 public:
  Trial(const RowWorld& world,
        const Method& method,
        Start start,
        similarity::SimilarityScoreSource& source,
        std::uint64_t seed)
      : world_(world),
        method_(method),
        source_(source),
        start_rng_(seed, "start"),
        newcomer_rng_(seed, "newcomers"),
        searches_(start == Start::kGlobal && method.annealed_start),
        filter_(filter_config(method),
                std::make_shared<const localization::PositionNoiseModel>(method.motion),
                first_particles(world, method, start, start_rng_),
                seed),
        // A robot whose yaw is unknown cannot take it from odometry: the first reading is the
        // compass's.
        first_model_(
            source,
            start == Start::kGlobal && method.heading == localization::HeadingStrategy::kOdometry
                ? localization::HeadingStrategy::kCompass
                : method.heading,
            method.weighting,
            method.combined),
        model_(source, method.heading, method.weighting, method.combined) {
    if (method.recovery) recovery_.emplace(*method.recovery);
  }

  Result<StopRecord> drive_to(std::size_t stop, const Clock& clock) {
    if (stop > 0) {
      filter_.predict(inverse(world_.odometry[stop - 1]) * world_.odometry[stop]);
    }
    observation::ScoreSourceObservationModel& model = stop == 0 ? first_model_ : model_;
    SEMVIEW_TRY_STATUS(model.set_observation(world_.observations[stop]));
    const bool searches = stop == 0 && searches_;
    const TimePoint before = clock.now();
    localization::UpdateReport report;
    if (searches) {
      SEMVIEW_TRY(report, search(model));
    } else {
      SEMVIEW_TRY(report, filter_.update(model));
    }
    const std::chrono::duration<double> taken = clock.now() - before;
    StopRecord record = measure(filter_.particles(), method_, world_.truth[stop]);
    if (method_.refine) SEMVIEW_TRY_STATUS(refine(record, world_.truth[stop]));
    record.stop = static_cast<int>(stop) + 1;
    record.update_s = taken.count();
    record.origins = model.last_scores().origins;
    record.effective_sample_size = report.effective_sample_size;
    const Pose2 map_from_odom = world_.truth.front() * inverse(world_.odometry.front());
    record.odometry_m = distance_m(map_from_odom * world_.odometry[stop], world_.truth[stop]);
    if (!searches) renew(report);
    return record;
  }

 private:
  Result<localization::UpdateReport> search(localization::ObservationModel& model) {
    SEMVIEW_TRY(ParticleSet found,
                localization::annealed_particles(model,
                                                 world_.free_cells,
                                                 method_.affine,
                                                 *method_.annealed_start,
                                                 kGlobalParticles,
                                                 start_rng_));
    filter_.restart(std::move(found));
    localization::UpdateReport report;
    report.effective_sample_size = static_cast<double>(kGlobalParticles);
    return report;
  }

  /// The camera stands over the robot's centre.
  Status refine(StopRecord& record, const Pose2& truth) {
    SEMVIEW_TRY(const observation::NearbyScores nearby,
                observation::score_nearby(source_, record.map_from_robot, record.affine));
    const std::optional<Pose2> refined = observation::refined_pose(nearby);
    if (refined) set_estimate(record, *refined, truth);
    return {};
  }

  void renew(const localization::UpdateReport& report) {
    const ParticleSet& known = filter_.particles();
    const double share = recovery_ ? recovery_->share_to_replace(report.mean_likelihood) : 0.0;
    const auto count = static_cast<std::size_t>(share * static_cast<double>(known.size()));
    if (count == 0) {
      filter_.resample_if_needed();
      return;
    }
    ParticleSet fresh = localization::uniform_particles(world_.free_cells, count, newcomer_rng_);
    for (std::size_t i = 0; i < count; ++i) {
      fresh[i].affine = known[i * known.size() / count].affine;
    }
    filter_.replace_some(std::move(fresh));
  }

  const RowWorld& world_;
  const Method& method_;
  similarity::SimilarityScoreSource& source_;
  Rng start_rng_;
  Rng newcomer_rng_;
  bool searches_;
  localization::ParticleFilter filter_;
  observation::ScoreSourceObservationModel first_model_;
  observation::ScoreSourceObservationModel model_;
  std::optional<localization::RecoveryMonitor> recovery_;
};

}  // namespace

RowWorld cut_world(const World& world, const Row& row, const PanoramaCamera& profile) {
  RowWorld cut;
  for (const Stop& stop : world.stops) {
    cut.truth.push_back(map::distort(stop.map_from_robot, row.affine));
    cut.odometry.push_back(stop.odom_from_robot);
    Observation observation;
    observation.classes = raw_classes();
    observation.labels = resample(stop.labels, world.camera, profile);
    for (int column = 0; column < profile.columns; ++column) {
      if (std::abs(profile.azimuth_rad(column)) <= row.field_of_view_rad / 2.0) continue;
      for (int r = 0; r < profile.rows; ++r) observation.labels.at(r, column) = kUnknown;
    }
    cut.observations.push_back(std::move(observation));
  }
  return cut;
}

similarity::WeightMatrix identity_of(const similarity::WeightMatrix& hand) {
  std::vector<similarity::WeightMatrix::Band> bands(hand.bands().begin(), hand.bands().end());
  const std::size_t columns = hand.map_names().size();
  for (similarity::WeightMatrix::Band& band : bands) {
    for (std::size_t j = 0; j < columns; ++j) {
      double full = 0.0;
      for (std::size_t i = 0; i < hand.observed_names().size(); ++i) {
        full = std::max(full, band.weights[i * columns + j]);
      }
      const bool surface = hand.map_names()[j] != similarity::kNoneColumn;
      for (std::size_t i = 0; i < hand.observed_names().size(); ++i) {
        double& weight = band.weights[i * columns + j];
        weight = surface && weight > 0.0 && weight == full ? 1.0 : 0.0;
      }
    }
  }
  return *similarity::WeightMatrix::build(
      {hand.observed_names().begin(), hand.observed_names().end()},
      {hand.map_names().begin(), hand.map_names().end()},
      std::move(bands));
}

similarity::WeightMatrix row_weights(const similarity::WeightMatrix& hand,
                                     WeightsKind kind,
                                     ClassSubset classes) {
  similarity::WeightMatrix weights = kind == WeightsKind::kIdentity ? identity_of(hand) : hand;
  if (classes != ClassSubset::kFurniture) return weights;
  // The plan's ground stands for everything that is not furniture: it says nothing.
  std::vector<similarity::WeightMatrix::Band> bands(weights.bands().begin(), weights.bands().end());
  const std::size_t columns = weights.map_names().size();
  for (similarity::WeightMatrix::Band& band : bands) {
    for (std::size_t j = 0; j < columns; ++j) {
      if (weights.map_names()[j] != "floor") continue;
      for (std::size_t i = 0; i < weights.observed_names().size(); ++i) {
        band.weights[i * columns + j] = 0.0;
      }
    }
  }
  return *similarity::WeightMatrix::build(
      {weights.observed_names().begin(), weights.observed_names().end()},
      {weights.map_names().begin(), weights.map_names().end()},
      std::move(bands));
}

Result<std::vector<StopRecord>> run_trial(const RowWorld& world,
                                          const Method& method,
                                          Start start,
                                          const similarity::WeightMatrix& weights,
                                          ViewSource& views,
                                          ThreadPool& pool,
                                          std::uint64_t seed,
                                          const Clock& clock) {
  similarity::SimilarityScoreSource source(views, world.map_classes, weights, pool);
  Trial trial(world, method, start, source, seed);
  std::vector<StopRecord> records;
  for (std::size_t i = 0; i < world.truth.size(); ++i) {
    SEMVIEW_TRY(StopRecord record, trial.drive_to(i, clock));
    records.push_back(record);
  }
  return records;
}

}  // namespace semview::paper2017
