// SPDX-License-Identifier: Apache-2.0
#include "client/lib/remote_score_source.hpp"

#include <utility>

#include <fmt/format.h>

#include "client/lib/remote_maps.hpp"
#include "client/lib/typed_call.hpp"
#include "semview/protocol/map_wire.hpp"
#include "semview/protocol/score_wire.hpp"

namespace semview::client {

Result<std::unique_ptr<RemoteScoreSource>> RemoteScoreSource::open(
    const ConnectionConfig& config, const std::string& map_id, similarity::WeightMatrix weights) {
  SEMVIEW_TRY(Connection connection, Connection::open(config));
  SEMVIEW_TRY(protocol::MapDescription map, get_map(connection, map_id));
  return std::unique_ptr<RemoteScoreSource>(
      new RemoteScoreSource(std::move(connection), std::move(map), weights));
}

RemoteScoreSource::RemoteScoreSource(Connection connection,
                                     protocol::MapDescription map,
                                     const similarity::WeightMatrix& weights)
    : connection_(std::move(connection)), map_(std::move(map)), weights_csv_(weights.to_csv()) {}

Status RemoteScoreSource::set_observation(const Observation& observation) {
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
  v1::SetObservationRequest request;
  protocol::to_wire(observation, &request);
  request.set_map_id(map_.summary.id);
  request.set_fingerprint(protocol::to_wire(map_.summary.fingerprint));
  request.set_weights_csv(weights_csv_);
  observation_body_ = request.SerializeAsString();
  return send_observation();
}

Status RemoteScoreSource::send_observation() {
  observation_id_.clear();
  SEMVIEW_TRY(const std::string body,
              connection_.call("SetObservation", *observation_body_, Repeat::kSafe));
  SEMVIEW_TRY(const auto reply, protocol::parse<v1::SetObservationReply>(body, "reply"));
  observation_id_ = reply.observation_id();
  return {};
}

Result<ScoreBatch> RemoteScoreSource::score(const ScoreRequest& request) {
  if (!observation_body_) {
    return fail(ErrorCode::kFailedPrecondition, "no observation was set");
  }
  v1::ScoreRequest wire;
  protocol::to_wire(request, &wire);
  wire.set_map_id(map_.summary.id);
  wire.set_fingerprint(protocol::to_wire(map_.summary.fingerprint));
  bool sent_now = false;
  for (;;) {
    if (observation_id_.empty()) {
      SEMVIEW_TRY_STATUS(send_observation());
      sent_now = true;
    }
    wire.set_observation_id(observation_id_);
    Result<v1::ScoreReply> reply = typed_call<v1::ScoreReply>(connection_, "Score", wire);
    if (reply) return protocol::from_wire(*reply, request);
    const bool forgotten =
        reply.error().code == ErrorCode::kNotFound && reply.error().field == "observation_id";
    if (!forgotten || sent_now) return fail(std::move(reply).error());
    // Restarted, or dropped in favour of others.
    observation_id_.clear();
  }
}

}  // namespace semview::client
