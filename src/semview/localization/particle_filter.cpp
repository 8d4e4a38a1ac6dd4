// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/particle_filter.hpp"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/localization/low_variance_resampling.hpp"

namespace semview::localization {

Status validate(const ParticleFilterConfig& config) {
  if (!(config.resample_threshold >= 0.0 && config.resample_threshold <= 1.0)) {
    return fail(
        Error{ErrorCode::kInvalidArgument,
              fmt::format("resample threshold is {}: expected 0 to 1", config.resample_threshold),
              "resample_threshold"});
  }
  if (config.affine) SEMVIEW_TRY_STATUS(validate(*config.affine));
  return validate(config.compass);
}

ParticleFilter::ParticleFilter(const ParticleFilterConfig& config,
                               std::shared_ptr<const MotionModel> motion,
                               ParticleSet particles,
                               std::uint64_t seed)
    : config_(config), motion_(std::move(motion)), particles_(std::move(particles)), seed_(seed) {
  SEMVIEW_CHECK(!particles_.empty() && motion_ != nullptr);
}

void ParticleFilter::restart(ParticleSet particles) {
  SEMVIEW_CHECK(!particles.empty());
  particles_ = std::move(particles);
}

void ParticleFilter::predict(const Pose2& before_from_after) {
  ++predictions_;
  Rng rng(seed_, "motion", predictions_);
  for (Particle& particle : particles_) {
    const double turned_by_rad = -particle.map_from_robot.yaw_rad;
    const Pose2 before = particle.map_from_robot;
    Pose2& after = particle.map_from_robot;
    after = motion_->sample(before, before_from_after, rng);
    if (!particle.affine.is_identity()) {
      // A true step as the drawn map has it.
      const double x_m = after.x_m - before.x_m;
      const double y_m = after.y_m - before.y_m;
      after.x_m = before.x_m + particle.affine.a * x_m;
      after.y_m = before.y_m + particle.affine.k * x_m + particle.affine.b * y_m;
    }
    particle.heading_rad =
        wrap_angle(particle.heading_rad + turned_by_rad + particle.map_from_robot.yaw_rad);
  }
}

Result<UpdateReport> ParticleFilter::update(ObservationModel& model) {
  SEMVIEW_TRY(const ObservationWeights weights, model.weigh(particles_));
  if (weights.log_weights.size() != particles_.size() ||
      (!weights.headings_rad.empty() && weights.headings_rad.size() != particles_.size())) {
    return fail(ErrorCode::kInternal,
                fmt::format("the observation model weighed {} of {} particles",
                            weights.log_weights.size(),
                            particles_.size()));
  }
  UpdateReport report;
  report.outcome = multiply_weights(particles_, weights.log_weights);
  report.effective_sample_size = effective_sample_size(particles_);
  if (!weights.headings_rad.empty() && report.outcome == WeightOutcome::kUsed) {
    apply_compass(particles_, weights.headings_rad, config_.compass);
  }
  return report;
}

bool ParticleFilter::resample_if_needed() {
  const double count = static_cast<double>(particles_.size());
  if (config_.resample_threshold < 1.0 &&
      effective_sample_size(particles_) >= config_.resample_threshold * count) {
    return false;
  }
  std::vector<double> weights;
  weights.reserve(particles_.size());
  for (const Particle& particle : particles_) weights.push_back(particle.weight);
  Rng rng(seed_, "resampling", predictions_);
  ParticleSet drawn;
  drawn.reserve(particles_.size());
  for (const std::uint32_t ancestor : low_variance_sample(weights, particles_.size(), rng)) {
    drawn.push_back(particles_[ancestor]);
    drawn.back().weight = 1.0 / count;
  }
  particles_ = std::move(drawn);
  if (config_.affine) {
    Rng affine_rng(seed_, "affine", predictions_);
    renew_affines(particles_, *config_.affine, affine_rng);
  }
  return true;
}

}  // namespace semview::localization
