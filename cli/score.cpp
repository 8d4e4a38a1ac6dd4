// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/lib/remote_maps.hpp"
#include "client/lib/remote_score_source.hpp"
#include "client/lib/remote_view_source.hpp"
#include "observation_option.hpp"
#include "pose_list.hpp"
#include "score_explain.hpp"
#include "semview/core/hash.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/io/output_path.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/similarity/similarity_score_source.hpp"
#include "server_option.hpp"
#include "site_options.hpp"
#include "verb.hpp"
#include "weights_option.hpp"

namespace semview::cli {
namespace {

using nlohmann::ordered_json;

struct Options {
  SiteOptions site;
  std::string server;  ///< empty: in this process
  ObservationOption observation;
  std::string weights;
  std::string pose;
  std::string poses;
  std::string explain;  ///< a picture; empty for none
  bool compass = false;
  bool curve = false;
  bool clip = false;
  bool json = false;
};

Result<ScoreRequest> request_of(const Options& options) {
  if (options.pose.empty() == options.poses.empty()) {
    return fail(Error{
        ErrorCode::kInvalidArgument, "give the poses with either --pose or --poses", "--pose"});
  }
  ScoreRequest request;
  if (options.pose.empty()) {
    SEMVIEW_TRY(request.poses, read_pose_list(options.poses));
  } else {
    SEMVIEW_TRY(const Pose2 pose, parse_pose("--pose", options.pose));
    request.poses.push_back(pose);
  }
  if (!options.explain.empty() && request.poses.size() != 1) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("--explain takes one pose, {} are given", request.poses.size()),
                      "--explain"});
  }
  const bool compass = options.compass || options.curve;
  request.mode = compass ? HeadingMode::kCompass : HeadingMode::kAsGiven;
  request.whole_curve = options.curve;
  return request;
}

/// Equation (1); nothing where a pose has no view.
std::optional<double> similarity_of(const ScoreBatch& batch, std::int32_t sum, bool clip) {
  if (sum == kNoView) return {};
  const double similarity = batch.similarity(sum);
  return clip ? std::max(similarity, 0.0) : similarity;
}

ordered_json number_or_null(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json pose_json(const ScoreRequest& request,
                       const ScoreBatch& batch,
                       std::size_t i,
                       bool clip) {
  const Pose2& pose = request.poses[i];
  ordered_json entry{{"x_m", pose.x_m},
                     {"y_m", pose.y_m},
                     {"yaw_deg", shown_deg(pose.yaw_rad)},
                     {"similarity", number_or_null(similarity_of(batch, batch.sums[i], clip))}};
  if (batch.sums[i] == kNoView) return entry;
  entry["sum"] = batch.sums[i];
  if (!batch.best_heading.empty()) {
    entry["best_yaw_deg"] = shown_deg(PoseGrid::heading_yaw_rad(batch.best_heading[i]));
  }
  if (request.whole_curve) {
    ordered_json curve = ordered_json::array();
    for (std::size_t k = 0; k < PoseGrid::kHeadings; ++k) {
      const std::int32_t sum = batch.curve[i * PoseGrid::kHeadings + k];
      curve.push_back(number_or_null(similarity_of(batch, sum, clip)));
    }
    entry["curve"] = std::move(curve);
  }
  return entry;
}

/// Who scores, this process or a server.
struct Scorer {
  std::shared_ptr<service::Site> site;  ///< what `source` stands on; null with a server
  std::unique_ptr<ScoreSource> source;
  std::optional<similarity::WeightMatrix> weights;
  ClassTable map_classes;
  std::string map_id;
  Fingerprint fingerprint;
  std::string engine, engine_reason;
};

Result<Scorer> open_remote(const Options& options, const ClassTable& observed) {
  SEMVIEW_TRY(const client::ConnectionConfig config,
              connection_to(options.server, "score", client::ConnectionConfig{}.timeout));
  SEMVIEW_TRY(client::Connection connection, client::Connection::open(config));
  SEMVIEW_TRY(const protocol::MapDescription map, client::get_map(connection, options.site.map));
  SEMVIEW_TRY(similarity::WeightMatrix weights,
              read_weights(options.weights, observed, map.classes));
  SEMVIEW_TRY(auto remote, client::RemoteScoreSource::open(config, options.site.map, weights));
  Scorer scorer;
  scorer.weights = std::move(weights);
  scorer.map_classes = map.classes;
  scorer.map_id = remote->map().summary.id;
  scorer.fingerprint = remote->map().summary.fingerprint;
  scorer.engine = remote->map().engine;
  scorer.engine_reason = remote->map().engine_reason;
  scorer.source = std::move(remote);
  return scorer;
}

Result<Scorer> open_scorer(const Options& options, const ClassTable& observed) {
  if (!options.server.empty()) return open_remote(options, observed);
  Scorer scorer;
  SEMVIEW_TRY(scorer.site, open_site(options.site));
  SEMVIEW_TRY(similarity::WeightMatrix weights,
              read_weights(options.weights, observed, scorer.site->map().classes));
  scorer.map_id = scorer.site->id();
  scorer.fingerprint = scorer.site->map().fingerprint;
  scorer.engine = scorer.site->engine().name;
  scorer.engine_reason = scorer.site->engine().reason;
  scorer.map_classes = scorer.site->map().classes;
  scorer.source = std::make_unique<similarity::SimilarityScoreSource>(
      scorer.site->views(), scorer.map_classes, weights, scorer.site->pool());
  scorer.weights = std::move(weights);
  return scorer;
}

/// Writes the picture of `--explain`; none unless it is asked for.
Result<std::optional<similarity::ScoreExplanation>> explain_for(const Options& options,
                                                                const Scorer& scorer,
                                                                const ScoreParts& parts,
                                                                const Pose2& pose,
                                                                const ScoreBatch& batch) {
  std::optional<similarity::ScoreExplanation> explanation;
  if (options.explain.empty()) return explanation;
  if (scorer.site) {
    SEMVIEW_TRY(explanation, explain(parts, scorer.site->views(), pose, batch, options.explain));
    return explanation;
  }
  SEMVIEW_TRY(const client::ConnectionConfig config,
              connection_to(options.server, "score", client::ConnectionConfig{}.timeout));
  SEMVIEW_TRY(const auto views, client::RemoteViewSource::open(config, options.site.map));
  SEMVIEW_TRY(explanation, explain(parts, *views, pose, batch, options.explain));
  return explanation;
}

void print_json(const Scorer& scorer,
                const ScoreRequest& request,
                const ScoreBatch& batch,
                bool clip,
                std::optional<ordered_json> explanation) {
  ordered_json json{{"map", scorer.map_id},
                    {"fingerprint", to_hex(scorer.fingerprint)},
                    {"engine", scorer.engine},
                    {"engine_reason", scorer.engine_reason},
                    {"weight_scale", batch.weight_scale},
                    {"observed_pixels", batch.observed_pixels},
                    {"cells",
                     {{"memory", batch.origins.memory},
                      {"disk", batch.origins.disk},
                      {"cast", batch.origins.cast}}}};
  ordered_json poses = ordered_json::array();
  for (std::size_t i = 0; i < request.poses.size(); ++i) {
    poses.push_back(pose_json(request, batch, i, clip));
  }
  json["poses"] = std::move(poses);
  if (explanation) json["explanation"] = *std::move(explanation);
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

void print_table(const ScoreRequest& request, const ScoreBatch& batch, const Options& options) {
  const bool compass = !batch.best_heading.empty();
  fmt::print("x_m,y_m,yaw_deg,similarity{}\n", compass ? ",best_yaw_deg" : "");
  for (std::size_t i = 0; i < request.poses.size(); ++i) {
    const Pose2& pose = request.poses[i];
    const auto similarity = similarity_of(batch, batch.sums[i], options.clip);
    fmt::print("{:g},{:g},{:g},{}",
               pose.x_m,
               pose.y_m,
               deg_from_rad(pose.yaw_rad),
               similarity ? fmt::format("{:.6f}", *similarity) : "no_view");
    if (compass) {
      fmt::print(",{:g}", deg_from_rad(PoseGrid::heading_yaw_rad(batch.best_heading[i])));
    }
    fmt::print("\n");
  }
  if (!options.curve) return;
  for (std::size_t i = 0; i < request.poses.size(); ++i) {
    fmt::print("\npose {}: yaw_deg,similarity\n", i);
    for (int k = 0; k < PoseGrid::kHeadings; ++k) {
      const std::size_t at = i * PoseGrid::kHeadings + static_cast<std::size_t>(k);
      const auto similarity = similarity_of(batch, batch.curve[at], options.clip);
      fmt::print("{:g},{}\n",
                 deg_from_rad(PoseGrid::heading_yaw_rad(k)),
                 similarity ? fmt::format("{:.6f}", *similarity) : "no_view");
    }
  }
}

Status score(const CLI::App& verb, const Options& options) {
  if (!options.server.empty()) SEMVIEW_TRY_STATUS(check_no_site_options(verb));
  if (!options.explain.empty()) SEMVIEW_TRY_STATUS(io::check_output_png(options.explain));
  SEMVIEW_TRY(const ScoreRequest request, request_of(options));
  SEMVIEW_TRY(const ClassTable observed, read_observed_classes(options.observation));
  SEMVIEW_TRY(const Scorer scorer, open_scorer(options, observed));
  SEMVIEW_TRY(const Observation observation,
              read(options.observation, scorer.source->profile().camera));
  SEMVIEW_TRY_STATUS(scorer.source->set_observation(observation));
  SEMVIEW_TRY(const ScoreBatch batch, scorer.source->score(request));
  const ScoreParts parts{observation, *scorer.weights, scorer.map_classes};
  SEMVIEW_TRY(const auto explanation,
              explain_for(options, scorer, parts, request.poses.front(), batch));
  if (options.json) {
    std::optional<ordered_json> tables;
    if (explanation) tables = explanation_json(*explanation, parts);
    print_json(scorer, request, batch, options.clip, std::move(tables));
    return {};
  }
  print_table(request, batch, options);
  if (explanation) print_explanation(*explanation, parts);
  return {};
}

}  // namespace

void add_score_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "score",
      "Compare an observation with the map's views at given poses: the mean weight over the "
      "observed pixels, 1 for a perfect match of distinctive classes. With --compass all 120 "
      "headings are tried at each position and the best is reported.");
  const auto options = std::make_shared<Options>();
  add_site_options(*verb, options->site);
  add_server_option(*verb, options->server, "score");
  add_observation_option(*verb, options->observation);
  add_weights_option(*verb, options->weights)->required();
  verb->add_option("--pose",
                   options->pose,
                   "One pose of the eye; where the camera is not over the robot's middle, that is "
                   "not the robot's")
      ->type_name("X,Y,YAW_DEG");
  verb->add_option("--poses", options->poses, "Poses of the eye, one a line: x,y,yaw_deg")
      ->type_name("FILE.csv");
  verb->add_flag("--compass", options->compass, "Try all 120 headings, report the best");
  verb->add_flag(
      "--curve", options->curve, "With the similarity of each heading (implies --compass)");
  verb->add_option("--explain",
                   options->explain,
                   "Of one pose, with the compass at its best heading: what raised and lowered the "
                   "score by pixel, in a picture, and by class, in tables behind the result")
      ->type_name("OUT.png");
  verb->add_flag("--clip-negative", options->clip, "Report negative similarities as 0");
  verb->add_flag("--json", options->json, "Print the result as JSON");
  verb->footer(
      "Example: semview score maps/duplex_level1 --obs obs --weights "
      "maps/duplex_level1/weights.csv --pose 3,-9,90 --compass");
  verb->callback([verb, options, &exit_code] { exit_code = report(score(*verb, *options)); });
}

}  // namespace semview::cli
