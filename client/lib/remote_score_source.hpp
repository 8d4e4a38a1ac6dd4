// SPDX-License-Identifier: Apache-2.0
/// A ScoreSource that lets a server do the work.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "client/lib/connection.hpp"
#include "client/lib/remote_heat_map.hpp"
#include "semview/protocol/descriptions.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/view/score_model.hpp"
#include "semview/view/score_source.hpp"

namespace semview::v1 {
class SetObservationRequest;
}

namespace semview::client {

/// Scores poses against one map of a server, by views or by depth, with the same numbers as
/// in-process.
///
/// Keeps the current observation: when the server was restarted or has dropped it, `score` sends
/// it again by itself. When the server cannot be reached, a call fails with kUnavailable or
/// kDeadlineExceeded after `config.timeout`, and those after it at once (0.1 s), so that a robot is
/// not held up at every frame; the first answer ends that.
class RemoteScoreSource final : public ScoreSource {
 public:
  /// Asks the server for the map.
  /// @errors kNotFound: no such map; those of `Connection::call`.
  static Result<std::unique_ptr<RemoteScoreSource>> open(const ConnectionConfig& config,
                                                         const std::string& map_id,
                                                         similarity::WeightMatrix weights);

  /// One that scores `Observation::voxels` by a model of depth.
  /// @errors as above
  static Result<std::unique_ptr<RemoteScoreSource>> open(const ConnectionConfig& config,
                                                         const std::string& map_id,
                                                         const DepthScoring& scoring);

  const ViewProfile& profile() const override { return map_.profile; }
  const protocol::MapDescription& map() const { return map_; }

  /// As ScoreSource; kFailedPrecondition also: the server now has another map under this id.
  /// After kUnavailable or kDeadlineExceeded the observation is still taken: the next `score`
  /// sends it.
  Status set_observation(const Observation& observation) override;
  Result<ScoreBatch> score(const ScoreRequest& request) override;

  /// How well the observation fits each free cell of the map: the values of
  /// `similarity::heat_map` in the server's process. A cold floor takes as long as its views take
  /// to cast: give the connection time.
  /// @errors those of `score`; kInvalidArgument: a region without free cells, headings or weights
  /// out of range; kResourceExhausted: too many cells.
  Result<HeatMapAnswer> heat_map(const HeatMapQuestion& question);

 private:
  RemoteScoreSource(Connection connection,
                    protocol::MapDescription map,
                    std::string weights_csv,
                    std::optional<DepthScoring> depth);
  Result<v1::SetObservationRequest> message_of(const Observation& observation) const;
  Status reach();
  Result<std::string> call(std::string_view method, std::string_view body);
  Status send_observation();
  template <typename Request>
  Result<std::string> ask(std::string_view method, Request* wire);

  Connection connection_;
  const protocol::MapDescription map_;
  const std::string weights_csv_;                ///< of views
  const std::optional<DepthScoring> depth_;      ///< none: views are scored
  std::optional<std::string> observation_body_;  ///< as sent, to repeat it
  bool lost_ = false;                            ///< the last call got no answer in time
  std::string observation_id_;                   ///< empty: the server does not have it
};

}  // namespace semview::client
