// SPDX-License-Identifier: Apache-2.0
#include "localize_belief_options.hpp"

#include <initializer_list>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace semview::cli {
namespace {

/// What a server scores at once.
constexpr std::size_t kMostDistortedParticles = 20'000;

void add_affine_options(CLI::App& verb, LocalizeOptions& options) {
  verb.add_flag("--estimate-map-affine",
                options.estimate_map_affine,
                "The map may be drawn stretched and sheared: estimate by how much, unless told "
                "otherwise with --heading combined and 2000 particles");
  const auto add = [&verb](const char* name, double& value, const char* meaning) {
    verb.add_option(name, value, std::string("--estimate-map-affine: ") + meaning)
        ->capture_default_str();
  };
  add("--affine-exact", options.affine.identity_share, "share of particles that trust the drawing");
  add("--affine-scale-sigma",
      options.affine.log_scale_sigma,
      "sigma of the logarithm of each axis's scale before anything was seen");
  add("--affine-shear-sigma", options.affine.shear_sigma, "sigma of the shear, likewise");
  add("--affine-drift",
      options.affine.drift,
      "how much the distortion differs from place to place: sigma for the root of each metre");
}

void add_kld_options(CLI::App& verb, LocalizeOptions& options) {
  verb.add_flag("--kld", options.kld, "As many particles as the belief needs (KLD-sampling)");
  verb.add_option("--kld-err", options.kld_sampling.kld_err, "--kld: most that may be missed")
      ->capture_default_str();
  verb.add_option("--kld-z",
                  options.kld_sampling.kld_z,
                  "--kld: normal quantile of how often it may be missed")
      ->capture_default_str();
  verb.add_option("--min-particles", options.kld_sampling.min_particles, "--kld: at least")
      ->capture_default_str();
  verb.add_option("--max-particles", options.kld_sampling.max_particles, "--kld: at most")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}))
      ->capture_default_str();
}

void add_recovery_options(CLI::App& verb, LocalizeOptions& options) {
  verb.add_option("--recovery",
                  options.recovery,
                  "When observations fit worse than they used to, draw some particles anew: "
                  "`uniform` over the free space, or `dense`, from what the frame says of every "
                  "free cell and heading")
      ->check(CLI::IsMember({"uniform", "dense"}));
  verb.add_option("--recovery-alpha-slow",
                  options.recovery_rates.recovery_alpha_slow,
                  "--recovery: decay of the long-term average")
      ->capture_default_str();
  verb.add_option("--recovery-alpha-fast",
                  options.recovery_rates.recovery_alpha_fast,
                  "--recovery: decay of the short-term average")
      ->capture_default_str();
}

tl::unexpected<Error> usage(const std::string& option, const std::string& message) {
  return fail(Error{ErrorCode::kInvalidArgument, option + ": " + message, option});
}

/// An option that nothing would come of is a slip of the hand.
Status check_parameters(const CLI::App& verb,
                        bool used,
                        const std::string& of,
                        std::initializer_list<const char*> options) {
  for (const char* option : options) {
    if (!used && verb.get_option(option)->count() > 0) return usage(option, "needs " + of);
  }
  return {};
}

/// Options that belong to one choice of --init, --heading, --weighting or --motion.
Status check_choices(const CLI::App& verb, const LocalizeOptions& options) {
  SEMVIEW_TRY_STATUS(
      check_parameters(verb, !options.init.empty(), "--init", {"--init-heading-sigma"}));
  SEMVIEW_TRY_STATUS(check_parameters(verb,
                                      heading_of(options) != "odometry",
                                      "--heading compass or combined",
                                      {"--compass-gain", "--compass-gate"}));
  const bool paper = options.motion == "paper";
  SEMVIEW_TRY_STATUS(
      check_parameters(verb, paper, "--motion paper", {"--sigma", "--heading-sigma"}));
  SEMVIEW_TRY_STATUS(check_parameters(
      verb, !paper, "--motion odometry", {"--alpha1", "--alpha2", "--alpha3", "--alpha4"}));
  // Where the model scores depth, `check_model` says what kappa and power mean.
  if (scores_depth(options.model)) return {};
  const bool power = options.weighting.transform == "power";
  SEMVIEW_TRY_STATUS(check_parameters(verb, power, "--weighting power", {"--power"}));
  return check_parameters(verb, !power, "--weighting exponential", {"--kappa"});
}

}  // namespace

void add_belief_options(CLI::App& verb, LocalizeOptions& options) {
  const std::size_t first = verb.get_options().size();
  verb.add_flag("--refine",
                options.refine,
                "Move the estimate between cells and headings, to the top of the similarity there");
  add_affine_options(verb, options);
  add_kld_options(verb, options);
  add_recovery_options(verb, options);
  const std::vector<CLI::Option*> all = verb.get_options();
  for (std::size_t i = first; i < all.size(); ++i) all[i]->group("Belief");
}

Status check_belief_options(const CLI::App& verb, const LocalizeOptions& options) {
  SEMVIEW_TRY_STATUS(check_choices(verb, options));
  SEMVIEW_TRY_STATUS(check_parameters(
      verb,
      options.estimate_map_affine,
      "--estimate-map-affine",
      {"--affine-exact", "--affine-scale-sigma", "--affine-shear-sigma", "--affine-drift"}));
  SEMVIEW_TRY_STATUS(check_parameters(
      verb, options.kld, "--kld", {"--kld-err", "--kld-z", "--min-particles", "--max-particles"}));
  SEMVIEW_TRY_STATUS(check_parameters(verb,
                                      !options.recovery.empty(),
                                      "--recovery",
                                      {"--recovery-alpha-slow", "--recovery-alpha-fast"}));
  SEMVIEW_TRY_STATUS(check_parameters(verb,
                                      heading_of(options) == "combined",
                                      "--heading combined",
                                      {"--combined-sigma", "--combined-lost"}));
  if (!options.estimate_map_affine) return {};
  const std::string most =
      fmt::format("expected at most {} with --estimate-map-affine", kMostDistortedParticles);
  if (options.particles > kMostDistortedParticles) {
    return usage("--particles", fmt::format("{}: {}", options.particles, most));
  }
  if (options.kld && options.kld_sampling.max_particles > kMostDistortedParticles) {
    return usage("--max-particles",
                 fmt::format("{}: {}", options.kld_sampling.max_particles, most));
  }
  return {};
}

void apply_belief_options(const LocalizeOptions& options, robot::LocalizerConfig& config) {
  config.refine = options.refine;
  if (options.estimate_map_affine) config.filter.affine = options.affine;
  if (options.kld) config.filter.kld = options.kld_sampling;
  if (options.recovery.empty()) return;
  config.recovery = options.recovery_rates;
  config.newcomers =
      options.recovery == "dense" ? robot::Newcomers::kDense : robot::Newcomers::kUniform;
}

}  // namespace semview::cli
