// SPDX-License-Identifier: Apache-2.0
#include "client/lib/remote_score_source.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/format.h>

#include "client/lib/remote_maps.hpp"
#include "semview/protocol/envelope.hpp"
#include "semview/protocol/map_wire.hpp"
#include "semview/protocol/model_wire.hpp"
#include "semview/protocol/score_wire.hpp"
#include "semview/protocol/voxel_wire.hpp"

namespace semview::client {
namespace {

/// How long a server that was lost is waited for at each call.
constexpr std::chrono::milliseconds kPatienceOfTheLost{100};

}  // namespace

Result<std::unique_ptr<RemoteScoreSource>> RemoteScoreSource::open(
    const ConnectionConfig& config, const std::string& map_id, similarity::WeightMatrix weights) {
  SEMVIEW_TRY(Connection connection, Connection::open(config));
  SEMVIEW_TRY(protocol::MapDescription map, get_map(connection, map_id));
  return std::unique_ptr<RemoteScoreSource>(
      new RemoteScoreSource(std::move(connection), std::move(map), weights.to_csv(), std::nullopt));
}

Result<std::unique_ptr<RemoteScoreSource>> RemoteScoreSource::open(const ConnectionConfig& config,
                                                                   const std::string& map_id,
                                                                   const DepthScoring& scoring) {
  SEMVIEW_TRY(Connection connection, Connection::open(config));
  SEMVIEW_TRY(protocol::MapDescription map, get_map(connection, map_id));
  return std::unique_ptr<RemoteScoreSource>(
      new RemoteScoreSource(std::move(connection), std::move(map), {}, scoring));
}

RemoteScoreSource::RemoteScoreSource(Connection connection,
                                     protocol::MapDescription map,
                                     std::string weights_csv,
                                     std::optional<DepthScoring> depth)
    : connection_(std::move(connection)),
      map_(std::move(map)),
      weights_csv_(std::move(weights_csv)),
      depth_(depth) {}

/// What the model looks at.
Result<v1::SetObservationRequest> RemoteScoreSource::message_of(
    const Observation& observation) const {
  v1::SetObservationRequest request;
  if (depth_) {
    if (!observation.voxels) {
      return fail(Error{ErrorCode::kInvalidArgument, "the observation has no depth", "voxels"});
    }
    for (const std::string& name : observation.voxels->classes.names()) {
      request.add_class_names(name);
    }
    protocol::to_wire(*observation.voxels, request.mutable_voxels());
    request.set_stamp_s(observation.stamp_s);
    return request;
  }
  const PanoramaCamera& camera = map_.profile.camera;
  if (observation.labels.rows() != camera.rows || observation.labels.columns() != camera.columns) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("observation of {} rows × {} columns; expected {} × {}",
                                  observation.labels.rows(),
                                  observation.labels.columns(),
                                  camera.rows,
                                  camera.columns),
                      "labels"});
  }
  protocol::to_wire(observation, &request);
  request.set_weights_csv(weights_csv_);
  return request;
}

Status RemoteScoreSource::set_observation(const Observation& observation) {
  SEMVIEW_TRY(v1::SetObservationRequest request, message_of(observation));
  request.set_map_id(map_.summary.id);
  request.set_fingerprint(protocol::to_wire(map_.summary.fingerprint));
  observation_body_ = request.SerializeAsString();
  return send_observation();
}

/// @errors kUnavailable: the server was lost, and is not back.
Status RemoteScoreSource::reach() {
  const ConnectionConfig& config = connection_.config();
  if (lost_) lost_ = !connection_.answers(std::min(config.timeout, kPatienceOfTheLost));
  if (!lost_) return {};
  return fail(ErrorCode::kUnavailable, fmt::format("no answer from {} yet", config.endpoint));
}

Result<std::string> RemoteScoreSource::call(std::string_view method, std::string_view body) {
  SEMVIEW_TRY_STATUS(reach());
  Result<std::string> reply = connection_.call(method, body, Repeat::kSafe);
  lost_ = !reply && (reply.error().code == ErrorCode::kUnavailable ||
                     reply.error().code == ErrorCode::kDeadlineExceeded);
  return reply;
}

Status RemoteScoreSource::send_observation() {
  observation_id_.clear();
  SEMVIEW_TRY(const std::string body, call("SetObservation", *observation_body_));
  SEMVIEW_TRY(const auto reply, protocol::parse<v1::SetObservationReply>(body, "reply"));
  observation_id_ = reply.observation_id();
  return {};
}

Result<ScoreBatch> RemoteScoreSource::score(const ScoreRequest& request) {
  if (!std::ranges::all_of(request.affines, &MapAffine::in_range)) {
    return fail(
        Error{ErrorCode::kInvalidArgument,
              "an affine is out of range: expected scales of 0.2 to 5 and a shear of -2 to 2",
              "affines"});
  }
  v1::ScoreRequest wire;
  protocol::to_wire(request, &wire);
  SEMVIEW_TRY(const std::string body, ask("Score", &wire));
  SEMVIEW_TRY(const auto scores, protocol::parse<v1::ScoreReply>(body, "reply"));
  return protocol::from_wire(scores, request);
}

Result<HeatMapAnswer> RemoteScoreSource::heat_map(const HeatMapQuestion& question) {
  v1::HeatmapRequest wire;
  to_wire(question, &wire);
  SEMVIEW_TRY(const std::string body, ask("Heatmap", &wire));
  SEMVIEW_TRY(const auto reply, protocol::parse<v1::HeatmapReply>(body, "reply"));
  return from_wire(reply, question);
}

/// Asks about the current observation, which the server may have to be sent first, or again.
template <typename Request>
Result<std::string> RemoteScoreSource::ask(std::string_view method, Request* wire) {
  if (!observation_body_) {
    return fail(ErrorCode::kFailedPrecondition, "no observation was set");
  }
  wire->set_map_id(map_.summary.id);
  wire->set_fingerprint(protocol::to_wire(map_.summary.fingerprint));
  if (depth_) {
    wire->set_model(protocol::to_wire(depth_->model));
    protocol::to_wire(*depth_, wire->mutable_scoring());
  }
  bool sent_now = false;
  for (;;) {
    if (observation_id_.empty()) {
      SEMVIEW_TRY_STATUS(send_observation());
      sent_now = true;
    }
    wire->set_observation_id(observation_id_);
    Result<std::string> reply = call(method, wire->SerializeAsString());
    if (reply) return reply;
    const bool forgotten =
        reply.error().code == ErrorCode::kNotFound && reply.error().field == "observation_id";
    if (!forgotten || sent_now) return fail(reply.error());
    // Restarted, or dropped in favour of others.
    observation_id_.clear();
  }
}

}  // namespace semview::client
