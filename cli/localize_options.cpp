// SPDX-License-Identifier: Apache-2.0
#include "localize_options.hpp"

#include <cmath>
#include <map>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "localize_belief_options.hpp"
#include "localize_start.hpp"
#include "semview/geometry/angle.hpp"
#include "verb.hpp"
#include "weights_option.hpp"

namespace semview::cli {
namespace {

constexpr std::size_t kMostParticles = 1'000'000;

tl::unexpected<Error> usage(const std::string& option, const std::string& message) {
  return fail(Error{ErrorCode::kInvalidArgument, fmt::format("{}: {}", option, message), option});
}

/// The modules name their own fields; people typed options.
Status as_option(const Status& status) {
  if (status) return {};
  static const std::map<std::string, std::string> kOptions{
      {"resample_threshold", "--resample-threshold"},
      {"gain", "--compass-gain"},
      {"gate_rad", "--compass-gate"},
      {"sigma_rad", "--combined-sigma"},
      {"lost_probability", "--combined-lost"},
      {"identity_share", "--affine-exact"},
      {"log_scale_sigma", "--affine-scale-sigma"},
      {"shear_sigma", "--affine-shear-sigma"},
      {"drift", "--affine-drift"},
      {"kld_err", "--kld-err"},
      {"kld_z", "--kld-z"},
      {"min_particles", "--min-particles"},
      {"max_particles", "--max-particles"},
      {"recovery_alpha_slow", "--recovery-alpha-slow"},
      {"recovery_alpha_fast", "--recovery-alpha-fast"},
      {"sigma_m", "--sigma"},
      {"heading_sigma_rad", "--heading-sigma"}};
  const std::string& field = status.error().field;
  const auto known = kOptions.find(field);
  return usage(known != kOptions.end() ? known->second : "--" + field, status.error().message);
}

/// Puts the options that `verb` has got since `first` under a heading of their own.
void group_since(CLI::App& verb, std::size_t first, const std::string& heading) {
  const std::vector<CLI::Option*> all = verb.get_options();
  for (std::size_t i = first; i < all.size(); ++i) all[i]->group(heading);
}

localization::HeadingStrategy heading_strategy(const LocalizeOptions& options) {
  using localization::HeadingStrategy;
  const std::string heading = heading_of(options);
  if (heading == "combined") return HeadingStrategy::kCombined;
  return heading == "compass" ? HeadingStrategy::kCompass : HeadingStrategy::kOdometry;
}

Status check_model(const CLI::App& verb, const LocalizeOptions& options) {
  SEMVIEW_TRY_STATUS(check_model_options(verb, options.model));
  if (!scores_depth(options.model)) return {};
  for (const char* option :
       {"--segment", "--weighting", "--power", "--refine", "--estimate-map-affine"}) {
    if (verb.get_option(option)->count() == 0) continue;
    return usage(option, fmt::format("needs --model views, not {}", options.model.model));
  }
  if (is_mixed(options.model)) return as_option(validate(mixed_config(options)));
  for (const char* option : {"--weights", "--kappa"}) {
    if (verb.get_option(option)->count() == 0) continue;
    return usage(option, fmt::format("needs --model views or mixed, not {}", options.model.model));
  }
  return {};
}

void add_start_options(CLI::App& verb, LocalizeOptions& options) {
  auto* init = verb.add_option("--init",
                               options.init,
                               "Known start, the pose at the log's first frame: metres, degrees "
                               "counter-clockwise, sigma in metres")
                   ->type_name("X,Y,YAW_DEG,SIGMA");
  verb.add_option("--init-heading-sigma",
                  options.init_heading_sigma_deg,
                  "Uncertainty of --init's heading in degrees")
      ->capture_default_str();
  verb.add_option_function<std::string>(
          "--global",
          [&options](const std::string& how) { options.global = how.empty() ? "sampled" : how; },
          "Unknown start: particles anywhere in the free space (`sampled`, the default), or drawn "
          "from what the first observation says of every free cell and heading (`dense`)")
      ->type_name("[sampled|dense]")
      ->expected(0, 1)
      ->check([](const std::string& how) {
        const bool known = how.empty() || how == "sampled" || how == "dense";
        return known ? std::string() : how + " is neither `sampled` nor `dense`";
      })
      ->excludes(init);
  verb.add_option(
          "--particles",
          options.particles,
          "Number of particles (default 500; 2000 with --global or --estimate-map-affine; 3000 "
          "where --model scores depth)")
      ->check(CLI::Range(std::size_t{1}, kMostParticles));
  verb.add_option("--seed", options.seed, "Seed of every random number")->capture_default_str();
}

void add_motion_options(CLI::App& verb, LocalizeOptions& options) {
  verb.add_option(
          "--motion", options.motion, "Motion model: `odometry` (alpha1..4) or `paper` (--sigma)")
      ->check(CLI::IsMember({"odometry", "paper"}))
      ->capture_default_str();
  verb.add_option("--alpha1", options.alphas.alpha1, "Rotation noise from rotation")
      ->capture_default_str();
  verb.add_option("--alpha2", options.alphas.alpha2, "Rotation noise from translation, rad2/m2")
      ->capture_default_str();
  verb.add_option("--alpha3", options.alphas.alpha3, "Translation noise from translation")
      ->capture_default_str();
  verb.add_option("--alpha4", options.alphas.alpha4, "Translation noise from rotation, m2/rad2")
      ->capture_default_str();
  verb.add_option("--sigma", options.sigma_m, "--motion paper: position noise a frame in m")
      ->capture_default_str();
  options.heading_sigma_deg = deg_from_rad(localization::PositionNoiseConfig{}.heading_sigma_rad);
  verb.add_option("--heading-sigma",
                  options.heading_sigma_deg,
                  "--motion paper: heading noise a frame in degrees")
      ->capture_default_str();
}

void add_filter_options(CLI::App& verb, LocalizeOptions& options) {
  verb.add_option(
          "--heading",
          options.heading,
          "Heading from `odometry`, from the visual `compass`, the best of all 120 headings, or "
          "`combined`: the best of them that is also near the one by odometry (default: odometry; "
          "combined with --estimate-map-affine, else compass with --global sampled of views)")
      ->check(CLI::IsMember({"odometry", "compass", "combined"}));
  const localization::CompassConfig compass;
  verb.add_option(
      "--compass-gain",
      options.compass_gain,
      fmt::format("Share of a small difference by which the compass corrects the odometry heading "
                  "(default {}, 1 with --heading combined)",
                  compass.gain));
  verb.add_option("--compass-gate",
                  options.compass_gate_deg,
                  fmt::format("Differences above this many degrees correct nothing (default {:g}, "
                              "180 with --heading combined)",
                              deg_from_rad(compass.gate_rad)));
  options.combined_sigma_deg = deg_from_rad(observation::CombinedHeadingConfig{}.sigma_rad);
  verb.add_option("--combined-sigma",
                  options.combined_sigma_deg,
                  "--heading combined: sigma of the heading by odometry in degrees")
      ->capture_default_str();
  verb.add_option("--combined-lost",
                  options.combined_lost,
                  "--heading combined: probability that the heading by odometry means nothing")
      ->capture_default_str();
  add_weighting_options(verb, options.weighting);
  verb.add_option("--resample-threshold",
                  options.resample_threshold,
                  "Resample when the effective sample size falls below this share; 1: every frame")
      ->capture_default_str();
  verb.add_option("--estimate",
                  options.estimate,
                  "Reported pose: strongest `mode`, weighted `mean`, or `best` particle")
      ->check(CLI::IsMember({"mode", "mean", "best"}))
      ->capture_default_str();
}

}  // namespace

void add_localize_options(CLI::App& verb, LocalizeOptions& options) {
  verb.add_option("--log", options.log, "Run log: a folder with log.yaml")
      ->type_name("DIR")
      ->required();
  verb.add_option(
          "--map", options.map, "Map folder, map.yaml, .glb or .vdb; with --server the map's id")
      ->type_name("MAP")
      ->required();
  verb.add_option("--server", options.server, "Let this server score")
      ->type_name("tcp://HOST:PORT");
  add_weights_option(verb, options.weights)
      ->description(
          "Weight matrix, or `identity`: a class of the same name scores 1, every other 0 "
          "(default: the map's own weights.csv, else `identity` where the log's classes are the "
          "map's)");
  verb.add_option("--segment",
                  options.segment,
                  "Label the log's images with this network: a shipped model's name, for example "
                  "deeplab_ade20k32, or a folder with model.yaml")
      ->type_name("MODEL");
  verb.add_option("-o,--out", options.output, "Estimated trajectory, TUM text")
      ->type_name("FILE.tum")
      ->required();
  verb.add_option(
          "--rate", options.rate, "Play the log at this multiple of its speed; 0: no waiting")
      ->capture_default_str();
  verb.add_option("--timeout", options.timeout_s, "Longest wait for the server in seconds")
      ->capture_default_str();
  verb.add_flag("--json", options.json, "Print a summary as JSON");

  const auto begin_group = [&verb] { return verb.get_options().size(); };
  std::size_t first = begin_group();
  add_start_options(verb, options);
  group_since(verb, first, "Start");
  first = begin_group();
  add_model_options(verb, options.model);
  group_since(verb, first, "Likelihood");
  first = begin_group();
  add_filter_options(verb, options);
  group_since(verb, first, "Filter");
  add_belief_options(verb, options);
  first = begin_group();
  add_motion_options(verb, options);
  group_since(verb, first, "Motion");
  first = begin_group();
  add_site_options(verb, options.site, false);
  // The map is named by --map, which with --server is an id and no path.
  verb.remove_option(verb.get_option("map"));
  group_since(verb, first, "Map in this process");
}

Status check_localize_options(const CLI::App& verb, const LocalizeOptions& options) {
  if (options.init.empty() && options.global.empty()) {
    return usage("--init", "expected a start: --init X,Y,YAW_DEG,SIGMA or --global");
  }
  if (!options.init.empty()) {
    if (const Result<KnownStart> start = known_start(options.init); !start) {
      return fail(start.error());
    }
  }
  if (!(options.rate >= 0.0) || !std::isfinite(options.rate)) {
    return usage("--rate", fmt::format("{}: expected a number >= 0", options.rate));
  }
  if (!(options.timeout_s >= 0.001 && options.timeout_s <= 3600.0)) {
    return usage("--timeout", fmt::format("{}: expected 0.001 to 3600 s", options.timeout_s));
  }
  if (!(options.init_heading_sigma_deg >= 0.0 && options.init_heading_sigma_deg <= 360.0)) {
    return usage("--init-heading-sigma",
                 fmt::format("{}: expected 0 to 360", options.init_heading_sigma_deg));
  }
  SEMVIEW_TRY_STATUS(check_belief_options(verb, options));
  SEMVIEW_TRY_STATUS(check_model(verb, options));
  return options.server.empty() ? Status() : check_no_site_options(verb);
}

observation::MixedConfig mixed_config(const LocalizeOptions& options) {
  return {options.weighting.kappa, options.model.effective_pixels};
}

Result<robot::LocalizerConfig> localizer_config(const LocalizeOptions& options) {
  robot::LocalizerConfig config;
  config.heading = heading_strategy(options);
  config.filter.resample_threshold = options.resample_threshold;
  if (config.heading == localization::HeadingStrategy::kCombined) {
    // The choice has looked at odometry already: it is the particle's yaw from then on.
    config.filter.compass = {1.0, kPi};
  }
  if (options.compass_gain) config.filter.compass.gain = *options.compass_gain;
  if (options.compass_gate_deg) {
    config.filter.compass.gate_rad = rad_from_deg(*options.compass_gate_deg);
  }
  config.combined = {rad_from_deg(options.combined_sigma_deg), options.combined_lost};
  config.weighting = weighting_of(options.weighting);
  if (scores_depth(options.model)) {
    config.weighting.transform = observation::WeightTransform::kExponential;
    // What both models give together is a logarithm of a likelihood already.
    config.weighting.kappa = is_mixed(options.model) ? 1.0 : options.model.effective_pixels;
    config.judges_lost = false;
  }
  config.estimate = options.estimate == "best"   ? localization::EstimateKind::kHighestWeight
                    : options.estimate == "mean" ? localization::EstimateKind::kWeightedMean
                                                 : localization::EstimateKind::kStrongestMode;
  apply_belief_options(options, config);
  SEMVIEW_TRY_STATUS(as_option(validate(config)));
  return config;
}

Result<std::shared_ptr<const localization::MotionModel>> motion_model(
    const LocalizeOptions& options) {
  if (options.motion == "odometry") {
    SEMVIEW_TRY_STATUS(as_option(validate(options.alphas)));
    return std::make_shared<localization::OdometryMotionModel>(options.alphas);
  }
  const localization::PositionNoiseConfig config{options.sigma_m,
                                                 rad_from_deg(options.heading_sigma_deg)};
  SEMVIEW_TRY_STATUS(as_option(validate(config)));
  return std::make_shared<localization::PositionNoiseModel>(config);
}

}  // namespace semview::cli
