// SPDX-License-Identifier: Apache-2.0
#include "depth_methods.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "semview/field/depth_scores.hpp"
#include "semview/field/field_likelihood.hpp"
#include "semview/protocol/envelope.hpp"
#include "semview/protocol/model_wire.hpp"
#include "semview/protocol/score_wire.hpp"
#include "semview/service/field_likelihoods.hpp"
#include "semview/service/site.hpp"
#include "semview/view/voxel_list.hpp"

namespace semview::server {
namespace {

struct DepthScores {
  DepthModel model;
  ScoreRequest request;
  ScoreBatch batch;
};

/// Blames the model where an error names no field.
template <typename Value>
Result<Value> of_model(Result<Value> result) {
  if (result || !result.error().field.empty()) return result;
  Error error = std::move(result).error();
  error.field = "model";
  return fail(std::move(error));
}

Status score_poses(DepthScores& scores, std::size_t begin, std::size_t end, ThreadPool& pool) {
  const auto first = scores.request.poses.begin();
  const ScoreRequest some{
      {first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(end)},
      scores.request.mode,
      scores.request.whole_curve};
  SEMVIEW_TRY(const ScoreBatch part,
              field::score_depth(*scores.model.likelihood, *scores.model.observation, some, pool));
  const auto put = [begin](const auto& from, auto& into, std::size_t each) {
    std::ranges::copy(from, into.begin() + static_cast<std::ptrdiff_t>(begin * each));
  };
  put(part.sums, scores.batch.sums, 1);
  put(part.best_heading, scores.batch.best_heading, 1);
  put(part.curve, scores.batch.curve, PoseGrid::kHeadings);
  return {};
}

}  // namespace

Result<DepthModel> depth_model(Services& services,
                               const service::Site& site,
                               const service::StoredObservation& stored,
                               ScoreModel model,
                               const v1::DepthScoring& wire) {
  if (stored.voxels == nullptr) {
    return fail(
        Error{ErrorCode::kFailedPrecondition,
              fmt::format("model {} needs depth, and the observation has none", name(model)),
              "model",
              "send `voxels` or `depth` with SetObservation"});
  }
  SEMVIEW_TRY(const DepthScoring scoring, protocol::from_wire(wire, model));
  DepthModel made;
  SEMVIEW_TRY(made.likelihood, of_model(site.likelihoods().of(scoring)));
  SEMVIEW_TRY(made.observation,
              of_model(made.likelihood->prepare(*stored.voxels, services.inline_pool)));
  return made;
}

Result<Plan> plan_depth_score(Services& services,
                              const Request& request,
                              DepthModel model,
                              const v1::ScoreRequest& wire) {
  if (wire.affines().a_size() > 0) {
    return protocol::wrong_field("affines", "depth is scored on maps as they are; expected none");
  }
  const auto scores = std::make_shared<DepthScores>();
  scores->model = std::move(model);
  SEMVIEW_TRY(scores->request, protocol::from_wire(wire, most_poses(services.limits, wire)));
  scores->batch = field::unscored_depth_batch(scores->request);
  const std::size_t poses = scores->request.poses.size();
  const std::size_t each =
      scores->request.mode == HeadingMode::kCompass ? std::size_t{PoseGrid::kHeadings} : 1;
  SEMVIEW_TRY_STATUS(check_queue(services, request, poses * each, "poses"));
  const std::size_t at_once = std::max<std::size_t>(kPosesPerChunk / each, 1);
  Plan plan;
  for (std::size_t begin = 0; begin < poses; begin += at_once) {
    const std::size_t end = std::min(begin + at_once, poses);
    plan.chunks.push_back(
        {(end - begin) * each, [scores, begin, end, &pool = services.inline_pool] {
           return score_poses(*scores, begin, end, pool);
         }});
  }
  plan.finish = [scores]() -> Result<std::string> {
    return protocol::to_wire(scores->batch).SerializeAsString();
  };
  return plan;
}

}  // namespace semview::server
