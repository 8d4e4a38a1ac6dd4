// SPDX-License-Identifier: Apache-2.0
/// `semview weights learn`.
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "learned_from.hpp"
#include "picture_set.hpp"
#include "semview/core/log.hpp"
#include "semview/io/output_path.hpp"
#include "semview/io/run_log.hpp"
#include "semview/io/text_file.hpp"
#include "semview/io/trajectory.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/similarity/weight_learner.hpp"
#include "site_options.hpp"
#include "verb.hpp"
#include "weights_verbs.hpp"

namespace semview::cli {
namespace {

struct Options {
  SiteOptions site;
  std::vector<std::string> logs;
  std::string list;
  std::string output;
  similarity::WeightLearnerConfig learner;
  bool json = false;
};

/// Of observations from where the map has no view: a robot's drive through its own map has none.
constexpr double kOddShare = 0.05;

/// Observations beside what the map shows from their poses.
class Lesson {
 public:
  Lesson(const service::Site& site, const similarity::WeightLearnerConfig& config)
      : site_(site), config_(config) {}

  /// @param name  what the observation is called if the map has no view from its pose
  Status add(const Observation& observation, const Pose2& map_from_robot, const std::string& name) {
    if (!learner_) {
      classes_ = observation.classes;
      learner_.emplace(config_, classes_, site_.map().classes, site_.profile().camera);
    }
    if (observation.classes != classes_) {
      return fail(ErrorCode::kInvalidArgument,
                  "its class list differs from that of the observations before it: one matrix is "
                  "for one network");
    }
    const Pose2 eye = map_from_robot * observation.base_from_eye;
    const auto cell = PoseGrid::cell(eye.x_m, eye.y_m);
    if (!cell || !site_.cells().has_eye(*cell)) {
      if (skipped_++ == 0)
        first_skipped_ = fmt::format("{} at ({:.2f}, {:.2f})", name, eye.x_m, eye.y_m);
      return {};
    }
    raycast::PanoramaRequest request;
    request.map_from_robot = eye;
    request.eye_z_m = site_.eye_z_m(site_.profile().eye_height_m);
    request.camera = site_.profile().camera;
    SEMVIEW_TRY(const raycast::Panorama view, site_.exact_panorama(request));
    learner_->add(observation.labels, view.labels);
    ++used_;
    return {};
  }

  Result<similarity::WeightMatrix> matrix() const {
    if (used_ > 0) return learner_->matrix();
    if (skipped_ == 0) return fail(ErrorCode::kFailedPrecondition, "no observations to learn from");
    return fail(ErrorCode::kFailedPrecondition,
                fmt::format("nothing to learn from: {}; expected the map that they were made in",
                            skipped_text()));
  }

  /// How many observations the map cannot answer for, and the first of them; empty if there are
  /// none.
  std::string skipped_text() const {
    if (skipped_ == 0) return "";
    return fmt::format(
        "{} of {} observations stand off map {} or where it has no eye, the first {}",
        skipped_,
        used_ + skipped_,
        site_.id(),
        first_skipped_);
  }
  std::size_t used() const { return used_; }
  std::size_t skipped() const { return skipped_; }  ///< from inside walls or outside of the map
  std::int64_t pixels() const { return learner_ ? learner_->pixels() : 0; }

 private:
  const service::Site& site_;
  similarity::WeightLearnerConfig config_;
  ClassTable classes_;
  std::optional<similarity::WeightLearner> learner_;
  std::size_t used_ = 0;
  std::size_t skipped_ = 0;
  std::string first_skipped_;
};

Status learn_from_log(const std::string& folder, const PanoramaCamera& profile, Lesson& lesson) {
  SEMVIEW_TRY(const io::RunLog log, io::read_run_log(folder));
  if (!log.groundtruth) {
    return fail(
        ErrorCode::kFailedPrecondition,
        fmt::format("{}: has no groundtruth.txt, so nobody knows what the robot should have "
                    "seen",
                    folder));
  }
  std::size_t without_truth = 0;
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    SEMVIEW_TRY(const Observation observation, io::read_frame(log, i, profile));
    const auto pose = io::interpolate(*log.groundtruth, observation.stamp_s);
    if (!pose) {  // before the first or after the last of them
      ++without_truth;
      continue;
    }
    Status added = lesson.add(observation, *pose, fmt::format("{}, frame {}", folder, i + 1));
    if (!added) {
      return with_context(std::move(added), folder);
    }
  }
  if (without_truth > 0) {
    log_warning(
        fmt::format("{}: {} of {} frames are not learned from: its ground truth does not "
                    "reach them",
                    folder,
                    without_truth,
                    log.frames.size()));
  }
  return {};
}

/// The module names its own fields; people typed options.
Status check_learner(const similarity::WeightLearnerConfig& config) {
  const Status valid = similarity::validate(config);
  if (valid) return {};
  const std::string& field = valid.error().field;
  const std::string option = field == "bands"          ? "--bands"
                             : field == "prior_pixels" ? "--prior-pixels"
                                                       : "--largest";
  return fail(Error{ErrorCode::kInvalidArgument, option + ": " + valid.error().message, option});
}

Status learn(const Options& options) {
  SEMVIEW_TRY_STATUS(io::check_output_file(options.output));
  SEMVIEW_TRY_STATUS(io::check_is_no_input(options.output, std::array{options.list}));
  SEMVIEW_TRY_STATUS(check_learner(options.learner));
  if (options.logs.empty() && options.list.empty()) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      "give run logs with ground truth, or observation folders with --list",
                      "--list"});
  }
  SEMVIEW_TRY(const std::shared_ptr<service::Site> site, open_site(options.site));
  Lesson lesson(*site, options.learner);
  for (const std::string& log : options.logs) {
    SEMVIEW_TRY_STATUS(learn_from_log(log, site->profile().camera, lesson));
  }
  if (!options.list.empty()) {
    SEMVIEW_TRY(const std::vector<KnownPicture> pictures,
                read_picture_list(options.list, site->cells(), site->profile().camera, nullptr));
    for (const KnownPicture& picture : pictures) {
      Status added = lesson.add(picture.observation,
                                picture.map_from_robot,
                                fmt::format("{}: {}", options.list, picture.name));
      if (!added) return with_context(std::move(added), picture.name);
    }
  }
  SEMVIEW_TRY(const similarity::WeightMatrix weights, lesson.matrix());
  if (static_cast<double>(lesson.skipped()) >
      kOddShare * static_cast<double>(lesson.used() + lesson.skipped())) {
    log_warning(lesson.skipped_text() + ": is it the right map?");
  }
  SEMVIEW_TRY(const std::string learned_from, learned_from_lines(options.logs));
  const std::string header = fmt::format(
      "{}# Logarithms of likelihood ratios, ln P(observed | map) - ln P(observed), learned by "
      "`semview "
      "weights learn`\n# from {} observations of map {}.\n",
      learned_from,
      lesson.used(),
      site->id());
  SEMVIEW_TRY_STATUS(io::write_text_file(options.output, header + weights.to_csv()));
  if (options.json) {
    const nlohmann::ordered_json json{{"weights", options.output},
                                      {"observations", lesson.used()},
                                      {"skipped", lesson.skipped()},
                                      {"pixels", lesson.pixels()},
                                      {"bands", weights.bands().size()},
                                      {"rows", weights.observed_names().size()},
                                      {"columns", weights.map_names().size()}};
    fmt::print("{}\n", json.dump(2));
    return {};
  }
  fmt::print("{}: {} x {} classes in {} bands of elevation, from {} observations{}\n",
             options.output,
             weights.observed_names().size(),
             weights.map_names().size(),
             weights.bands().size(),
             lesson.used(),
             lesson.skipped() == 0
                 ? std::string()
                 : fmt::format(" ({} more from where the map has no eye)", lesson.skipped()));
  return {};
}

}  // namespace

void add_weights_learn(CLI::App& weights, int& exit_code) {
  CLI::App* verb = weights.add_subcommand(
      "learn",
      "Learn a matrix from observations with known poses: ln P(observed | map) - ln P(observed), "
      "counted over the pixels of each band of elevation. Use it with an exponential weighting "
      "(`localize --weighting exponential`) and with `locate`.");
  const auto options = std::make_shared<Options>();
  add_site_options(*verb, options->site);
  verb->add_option("LOG", options->logs, "Run logs with ground truth");
  verb->add_option("--list", options->list, "Lines of folder,x_m,y_m,yaw_deg: observation folders")
      ->type_name("FILE.csv");
  verb->add_option("-o,--output", options->output, "CSV file to write")->required();
  verb->add_option("--bands", options->learner.bands, "Bands of elevation, of equal height")
      ->capture_default_str();
  verb->add_option("--prior-pixels",
                   options->learner.prior_pixels,
                   "Added to each class's count: a pair that never met is unlikely, not impossible")
      ->capture_default_str();
  verb->add_option("--largest", options->learner.largest_weight, "Weights are kept within ± this")
      ->capture_default_str();
  verb->add_flag("--json", options->json, "Print the result as JSON");
  verb->footer("Example: semview weights learn maps/duplex_level1 run1 run2 -o learned.csv");
  verb->callback([options, &exit_code] { exit_code = report(learn(*options)); });
}

}  // namespace semview::cli
