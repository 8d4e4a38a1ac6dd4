// SPDX-License-Identifier: Apache-2.0
#include "trial.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "raw_classes.hpp"
#include "semview/core/random.hpp"
#include "semview/localization/initialization.hpp"
#include "semview/localization/particle_filter.hpp"
#include "semview/map/distortion.hpp"
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
  const Pose2 estimate = localization::estimate_pose(particles, method.estimate).map_from_robot;
  record.map_from_robot = estimate;
  record.estimate_m = distance_m(estimate, truth);
  record.heading_rad = std::abs(wrap_angle(estimate.yaw_rad - truth.yaw_rad));
  record.affine = localization::estimate_affine(particles).mean;
  record.particles = particles.size();
  record.effective_sample_size = localization::effective_sample_size(particles);
  return record;
}

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
  Rng start_rng(seed, "start");
  localization::ParticleFilterConfig config;
  config.resample_threshold = 1.0;
  config.compass.gain = method.compass_gain;
  config.compass.gate_rad = kPi;
  config.affine = method.affine;
  localization::ParticleFilter filter(
      config,
      std::make_shared<const localization::PositionNoiseModel>(method.motion),
      first_particles(world, method, start, start_rng),
      seed);
  similarity::SimilarityScoreSource source(views, world.map_classes, weights, pool);
  observation::ScoreSourceObservationModel model(
      source, method.heading, method.weighting, method.combined);
  // A robot whose yaw is unknown cannot take it from odometry: the first reading is the compass's.
  observation::ScoreSourceObservationModel first_model(
      source,
      start == Start::kGlobal && method.heading == localization::HeadingStrategy::kOdometry
          ? localization::HeadingStrategy::kCompass
          : method.heading,
      method.weighting,
      method.combined);
  const Pose2 map_from_odom = world.truth.front() * inverse(world.odometry.front());
  std::vector<StopRecord> records;
  for (std::size_t i = 0; i < world.truth.size(); ++i) {
    if (i > 0) filter.predict(inverse(world.odometry[i - 1]) * world.odometry[i]);
    observation::ScoreSourceObservationModel& used = i == 0 ? first_model : model;
    SEMVIEW_TRY_STATUS(used.set_observation(world.observations[i]));
    const TimePoint before = clock.now();
    localization::UpdateReport report;
    const bool searches = i == 0 && start == Start::kGlobal && method.annealed_start;
    if (searches) {
      SEMVIEW_TRY(ParticleSet found,
                  localization::annealed_particles(used,
                                                   world.free_cells,
                                                   method.affine,
                                                   *method.annealed_start,
                                                   kGlobalParticles,
                                                   start_rng));
      filter.restart(std::move(found));
      report.effective_sample_size = static_cast<double>(kGlobalParticles);
    } else {
      SEMVIEW_TRY(report, filter.update(used));
    }
    const std::chrono::duration<double> taken = clock.now() - before;
    StopRecord record = measure(filter.particles(), method, world.truth[i]);
    record.stop = static_cast<int>(i) + 1;
    record.update_s = taken.count();
    record.origins = used.last_scores().origins;
    record.effective_sample_size = report.effective_sample_size;
    record.odometry_m = distance_m(map_from_odom * world.odometry[i], world.truth[i]);
    records.push_back(record);
    if (!searches) filter.resample_if_needed();
  }
  return records;
}

}  // namespace semview::paper2017
