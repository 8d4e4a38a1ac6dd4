// SPDX-License-Identifier: Apache-2.0
#include "score_explain.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "semview/geometry/angle.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/io/png.hpp"
#include "semview/picture/explanation_picture.hpp"

namespace semview::cli {
namespace {

using nlohmann::ordered_json;
using similarity::ClassContribution;
using similarity::ScoreExplanation;

std::string_view map_name(const ScoreParts& parts, ClassId id) {
  return id == kNoHit ? similarity::kNoneColumn : parts.map_classes.name(id);
}

double share_of(const ClassContribution& contribution, const ScoreExplanation& explanation) {
  return static_cast<double>(contribution.pixels) /
         static_cast<double>(explanation.observed_pixels);
}

ordered_json json_of(const ClassContribution& contribution,
                     const ScoreExplanation& explanation,
                     ordered_json entry) {
  entry["pixels"] = contribution.pixels;
  entry["share"] = share_of(contribution, explanation);
  entry["sum"] = contribution.sum;
  entry["contribution"] = explanation.similarity(contribution.sum);
  return entry;
}

RgbImage picture_of(const ScoreExplanation& explanation,
                    const ScoreParts& parts,
                    const PanoramaCamera& camera,
                    const Pose2& pose,
                    int heading) {
  picture::ExplanationPicture picture;
  picture.observed = parts.observation.labels;
  picture.observed_classes = parts.observation.classes;
  picture.view = explanation.view;
  picture.map_classes = parts.map_classes;
  picture.contributions = Image<double>(camera.rows, camera.columns);
  std::ranges::transform(
      explanation.contributions.pixels(),
      picture.contributions.pixels().begin(),
      [&](std::int32_t part) { return static_cast<double>(part) / explanation.weight_scale; });
  picture.camera = camera;
  picture.title = fmt::format("similarity {:.4f} at ({:g}, {:g}) m, {:g}°",
                              explanation.similarity(explanation.sum),
                              pose.x_m,
                              pose.y_m,
                              deg_from_rad(PoseGrid::heading_yaw_rad(heading)));
  return draw_explanation(picture);
}

}  // namespace

Result<ScoreExplanation> explain(const ScoreParts& parts,
                                 ViewSource& views,
                                 const Pose2& pose,
                                 const ScoreBatch& batch,
                                 const std::string& output) {
  const auto key = PoseGrid::key(pose);
  const std::string place = fmt::format("({:g}, {:g}) m", pose.x_m, pose.y_m);
  if (!key || batch.sums[0] == kNoView) {
    return fail(ErrorCode::kFailedPrecondition,
                fmt::format("--explain: there is no view at {}; expected a place inside the "
                            "building, at most 0.5 m from where an eye can be",
                            place));
  }
  const std::array<CellIndex, 1> cells{key->cell};
  SEMVIEW_TRY(const ViewBatch seen, views.views(cells));
  const int heading = batch.best_heading.empty() ? key->heading : batch.best_heading[0];
  const PanoramaCamera& camera = views.profile().camera;
  const bool has_view = seen.views.size() == 1 && seen.views[0] != nullptr;
  std::optional<ScoreExplanation> explanation;
  if (has_view) {
    SEMVIEW_TRY(
        explanation,
        similarity::explain_score(
            parts.observation, parts.weights, parts.map_classes, camera, *seen.views[0], heading));
  }
  if (!explanation || explanation->sum != batch.sums[0]) {
    return fail(ErrorCode::kFailedPrecondition,
                fmt::format("--explain: the view at {} is not the one that was scored; has the "
                            "server another map by now?",
                            place));
  }
  SEMVIEW_TRY_STATUS(io::write_png(output, picture_of(*explanation, parts, camera, pose, heading)));
  return *std::move(explanation);
}

void print_explanation(const ScoreExplanation& explanation, const ScoreParts& parts) {
  const auto numbers = [&](const ClassContribution& contribution) {
    return fmt::format("{:.4f},{:+.6f}",
                       share_of(contribution, explanation),
                       explanation.similarity(contribution.sum));
  };
  fmt::print("\nobserved,share,contribution\n");
  for (const ClassContribution& all : explanation.observed) {
    fmt::print("{},{}\n", parts.observation.classes.name(all.observed), numbers(all));
  }
  fmt::print("\nobserved,map,share,contribution\n");
  for (const ClassContribution& pair : explanation.pairs) {
    fmt::print("{},{},{}\n",
               parts.observation.classes.name(pair.observed),
               map_name(parts, pair.map),
               numbers(pair));
  }
}

ordered_json explanation_json(const ScoreExplanation& explanation, const ScoreParts& parts) {
  ordered_json json{{"observed", ordered_json::array()}, {"pairs", ordered_json::array()}};
  for (const ClassContribution& all : explanation.observed) {
    const std::string name(parts.observation.classes.name(all.observed));
    json["observed"].push_back(json_of(all, explanation, {{"observed", name}}));
  }
  for (const ClassContribution& pair : explanation.pairs) {
    const std::string name(parts.observation.classes.name(pair.observed));
    const std::string map(map_name(parts, pair.map));
    json["pairs"].push_back(json_of(pair, explanation, {{"observed", name}, {"map", map}}));
  }
  return json;
}

}  // namespace semview::cli
