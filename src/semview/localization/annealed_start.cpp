// SPDX-License-Identifier: Apache-2.0
#include "semview/localization/annealed_start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/localization/initialization.hpp"
#include "semview/localization/low_variance_resampling.hpp"

namespace semview::localization {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr int kBisections = 40;

/// A hypothesis that was weighed: its yaw stays unknown, its heading is the best one there.
struct Weighed {
  Particle particle;
  double log_likelihood = kImpossible;
};

class Sampler {
 public:
  Sampler(ObservationModel& model,
          std::span<const CellIndex> free_cells,
          const std::optional<AffineStateConfig>& affine,
          const AnnealedStartConfig& config,
          Rng& rng)
      : model_(model),
        free_cells_(free_cells.begin(), free_cells.end()),
        affine_(affine),
        config_(config),
        rng_(rng) {
    std::ranges::sort(free_cells_);
  }

  Result<ParticleSet> run(std::size_t count) {
    ParticleSet first = uniform_particles(free_cells_, config_.hypotheses, rng_);
    if (affine_) spread_affines(first, *affine_, rng_);
    SEMVIEW_TRY(belief_, weigh(std::move(first)));
    if (std::ranges::none_of(belief_, [](const Weighed& one) { return possible(one); })) {
      return fail(ErrorCode::kFailedPrecondition,
                  "the observation is possible nowhere: no hypothesis has a weight");
    }
    double exponent = 0.0;
    for (int round = 1; exponent < config_.exponent; ++round) {
      const double before = std::exchange(
          exponent, round >= config_.most_rounds ? config_.exponent : next_exponent(exponent));
      resample(exponent - before, config_.survivors);
      for (int i = 0; i < config_.moves; ++i) SEMVIEW_TRY_STATUS(move(exponent));
    }
    resample(0.0, count);
    ParticleSet particles;
    particles.reserve(count);
    for (Weighed& one : belief_) {
      one.particle.map_from_robot.yaw_rad = one.particle.heading_rad;
      one.particle.yaw_known = true;
      one.particle.weight = 1.0 / static_cast<double>(count);
      particles.push_back(one.particle);
    }
    return particles;
  }

 private:
  static bool possible(const Weighed& one) { return std::isfinite(one.log_likelihood); }

  Result<std::vector<Weighed>> weigh(ParticleSet particles) {
    SEMVIEW_TRY(const ObservationWeights weights, model_.weigh(particles));
    if (weights.log_weights.size() != particles.size() ||
        (!weights.headings_rad.empty() && weights.headings_rad.size() != particles.size())) {
      return fail(ErrorCode::kInternal,
                  fmt::format("the observation model weighed {} of {} hypotheses",
                              weights.log_weights.size(),
                              particles.size()));
    }
    std::vector<Weighed> weighed;
    weighed.reserve(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) {
      Weighed one{particles[i]};
      if (std::isfinite(weights.log_weights[i])) one.log_likelihood = weights.log_weights[i];
      if (!weights.headings_rad.empty() && std::isfinite(weights.headings_rad[i])) {
        one.particle.heading_rad = wrap_angle(weights.headings_rad[i]);
      }
      weighed.push_back(one);
    }
    return weighed;
  }

  /// Weights of the likelihood to the power `by`; the highest is 1.
  std::vector<double> weights(double by) const {
    double highest = kImpossible;
    for (const Weighed& one : belief_) highest = std::max(highest, one.log_likelihood);
    std::vector<double> all;
    all.reserve(belief_.size());
    for (const Weighed& one : belief_) {
      all.push_back(possible(one) ? std::exp(by * (one.log_likelihood - highest)) : 0.0);
    }
    return all;
  }

  double effective(double by) const {
    double sum = 0.0;
    double squares = 0.0;
    for (const double weight : weights(by)) {
      sum += weight;
      squares += weight * weight;
    }
    return sum * sum / squares;
  }

  /// The largest one that leaves as many effective samples as asked for.
  double next_exponent(double exponent) const {
    const double wanted =
        config_.keep * std::min(effective(0.0), static_cast<double>(config_.survivors));
    double low = 0.0;
    double high = config_.exponent - exponent;
    if (effective(high) >= wanted) return config_.exponent;
    for (int i = 0; i < kBisections; ++i) {
      const double middle = 0.5 * (low + high);
      (effective(middle) >= wanted ? low : high) = middle;
    }
    return exponent + low;
  }

  void resample(double by, std::size_t count) {
    std::vector<Weighed> drawn;
    drawn.reserve(count);
    for (const std::uint32_t ancestor : low_variance_sample(weights(by), count, rng_)) {
      drawn.push_back(belief_[ancestor]);
    }
    belief_ = std::move(drawn);
  }

  /// One Metropolis-Hastings step of every survivor under the likelihood to the power `exponent`.
  Status move(double exponent) {
    ParticleSet proposed;
    proposed.reserve(belief_.size());
    for (const Weighed& one : belief_) {
      Particle particle = one.particle;
      particle.map_from_robot.x_m += rng_.normal(0.0, config_.move_m);
      particle.map_from_robot.y_m += rng_.normal(0.0, config_.move_m);
      if (affine_) particle.affine = moved(particle.affine, config_.move_affine, rng_);
      proposed.push_back(particle);
    }
    SEMVIEW_TRY(const std::vector<Weighed> weighed, weigh(std::move(proposed)));
    for (std::size_t i = 0; i < belief_.size(); ++i) {
      const double mark = rng_.uniform();
      if (!possible(weighed[i]) || !is_free(weighed[i].particle)) continue;
      double log_ratio = exponent * (weighed[i].log_likelihood - belief_[i].log_likelihood);
      if (affine_) {
        log_ratio += log_prior(weighed[i].particle.affine, *affine_) -
                     log_prior(belief_[i].particle.affine, *affine_);
      }
      if (mark < std::exp(std::min(0.0, log_ratio))) belief_[i] = weighed[i];
    }
    return {};
  }

  bool is_free(const Particle& particle) const {
    const auto cell = PoseGrid::cell(particle.map_from_robot.x_m, particle.map_from_robot.y_m);
    return cell && std::ranges::binary_search(free_cells_, *cell);
  }

  ObservationModel& model_;
  std::vector<CellIndex> free_cells_;
  const std::optional<AffineStateConfig>& affine_;
  const AnnealedStartConfig& config_;
  Rng& rng_;
  std::vector<Weighed> belief_;
};

}  // namespace

Status validate(const AnnealedStartConfig& config) {
  const auto require = [](bool valid, const char* field, double value, const char* expected) {
    if (valid) return Status();
    return Status(fail(Error{ErrorCode::kInvalidArgument,
                             fmt::format("{} is {}: expected {}", field, value, expected),
                             field}));
  };
  const auto number = [](std::size_t count) { return static_cast<double>(count); };
  SEMVIEW_TRY_STATUS(
      require(config.survivors >= 1, "survivors", number(config.survivors), "at least 1"));
  SEMVIEW_TRY_STATUS(require(config.hypotheses >= config.survivors,
                             "hypotheses",
                             number(config.hypotheses),
                             "at least as many as survivors"));
  SEMVIEW_TRY_STATUS(require(config.exponent > 0.0 && config.exponent <= 1.0,
                             "exponent",
                             config.exponent,
                             "above 0, at most 1"));
  SEMVIEW_TRY_STATUS(
      require(config.keep > 0.0 && config.keep < 1.0, "keep", config.keep, "above 0, below 1"));
  SEMVIEW_TRY_STATUS(
      require(config.most_rounds >= 1, "most_rounds", config.most_rounds, "at least 1"));
  SEMVIEW_TRY_STATUS(require(config.moves >= 1, "moves", config.moves, "at least 1"));
  SEMVIEW_TRY_STATUS(require(config.move_m > 0.0 && std::isfinite(config.move_m),
                             "move_m",
                             config.move_m,
                             "a number > 0"));
  return require(config.move_affine >= 0.0 && std::isfinite(config.move_affine),
                 "move_affine",
                 config.move_affine,
                 "a number >= 0");
}

Result<ParticleSet> annealed_particles(ObservationModel& model,
                                       std::span<const CellIndex> free_cells,
                                       const std::optional<AffineStateConfig>& affine,
                                       const AnnealedStartConfig& config,
                                       std::size_t count,
                                       Rng& rng) {
  SEMVIEW_CHECK(!free_cells.empty() && count > 0);
  return Sampler(model, free_cells, affine, config, rng).run(count);
}

}  // namespace semview::localization
