// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/particle_filter.hpp"

#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/localization/low_variance_resampling.hpp"

namespace semview::localization {
namespace {

/// The root of the likelihood that recovery follows: with p = 20 of the default weights this is the
/// similarity.
constexpr double kTempering = 1.0 / 20.0;

double mean_likelihood(const ParticleSet& particles, std::span<const double> log_weights) {
  double total = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    total += particles[i].weight;
    if (std::isfinite(log_weights[i])) {
      sum += particles[i].weight * std::exp(kTempering * log_weights[i]);
    }
  }
  return total > 0.0 ? sum / total : 0.0;
}

}  // namespace

Status validate(const ParticleFilterConfig& config) {
  if (!(config.resample_threshold >= 0.0 && config.resample_threshold <= 1.0)) {
    return fail(
        Error{ErrorCode::kInvalidArgument,
              fmt::format("resample threshold is {}: expected 0 to 1", config.resample_threshold),
              "resample_threshold"});
  }
  if (config.affine) SEMVIEW_TRY_STATUS(validate(*config.affine));
  if (config.kld) SEMVIEW_TRY_STATUS(validate(*config.kld));
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
    // The identity is left out so that it costs no rounding.
    if (!particle.affine.is_identity()) after = drawn_move(before, after, particle.affine);
    particle.heading_rad =
        wrap_angle(particle.heading_rad + turned_by_rad + particle.map_from_robot.yaw_rad);
  }
  if (!config_.affine) return;
  Rng affine_rng(seed_, "affine walk", predictions_);
  walk_affines(particles_,
               *config_.affine,
               std::hypot(before_from_after.x_m, before_from_after.y_m),
               affine_rng);
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
  report.mean_likelihood = mean_likelihood(particles_, weights.log_weights);
  report.outcome = multiply_weights(particles_, weights.log_weights);
  report.effective_sample_size = effective_sample_size(particles_);
  if (!weights.headings_rad.empty() && report.outcome == WeightOutcome::kUsed) {
    apply_compass(particles_, weights.headings_rad, config_.compass);
  }
  return report;
}

/// `count` of the particles by weight, equally weighted.
ParticleSet ParticleFilter::draw(std::size_t count) {
  std::vector<double> weights;
  weights.reserve(particles_.size());
  for (const Particle& particle : particles_) weights.push_back(particle.weight);
  Rng rng(seed_, "resampling", predictions_);
  ParticleSet drawn;
  drawn.reserve(count);
  for (const std::uint32_t ancestor : low_variance_sample(weights, count, rng)) {
    drawn.push_back(particles_[ancestor]);
    drawn.back().weight = 1.0 / static_cast<double>(count);
  }
  if (config_.affine) {
    Rng affine_rng(seed_, "affine", predictions_);
    renew_affines(drawn, *config_.affine, affine_rng);
  }
  return drawn;
}

bool ParticleFilter::resample_if_needed() {
  const std::size_t count = particles_.size();
  std::size_t wanted = count;
  if (config_.kld) {
    Rng rng(seed_, "kld", predictions_);
    wanted = kld_sample_count(particles_, *config_.kld, rng);
  }
  const bool degenerate =
      config_.resample_threshold >= 1.0 ||
      effective_sample_size(particles_) < config_.resample_threshold * static_cast<double>(count);
  if (!degenerate && 2 * wanted >= count && wanted <= 2 * count) return false;
  particles_ = draw(wanted);
  return true;
}

void ParticleFilter::replace_some(ParticleSet newcomers) {
  SEMVIEW_CHECK(newcomers.size() < particles_.size());
  if (newcomers.empty()) return;
  const double weight = 1.0 / static_cast<double>(particles_.size());
  ParticleSet mixed = draw(particles_.size() - newcomers.size());
  mixed.insert(mixed.end(), newcomers.begin(), newcomers.end());
  for (Particle& particle : mixed) particle.weight = weight;
  particles_ = std::move(mixed);
}

}  // namespace semview::localization
