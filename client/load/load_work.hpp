// SPDX-License-Identifier: Apache-2.0
/// What simulated robots ask: prepared before a run, so that the generator costs little in it.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "client/lib/connection.hpp"
#include "client/load/open_loop.hpp"
#include "semview/core/result.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/view/observation.hpp"
#include "semview/view/score_source.hpp"

namespace semview::client {

enum class LoadKind {
  kGlobal,    ///< a robot that may be anywhere: compass in up to 2000 distinct free cells
  kTracking,  ///< one that knows where it is: 300 poses around it, headings as given
};

inline constexpr std::size_t kGlobalCells = 2000;
inline constexpr std::size_t kTrackingPoses = 300;
/// Spread of the tracking poses around the robot.
inline constexpr double kTrackingSigma_m = 0.3;
inline constexpr double kTrackingSigma_rad = 0.15;
/// Places at which robots stand in turn; a robot comes to another in each cycle.
inline constexpr std::size_t kPlaces = 32;

/// Observations from places in a map and the poses that are scored against each. All robots use
/// them, each in an order of its own.
class LoadWork final : public LoadBodies {
 public:
  /// Asks the server behind `config` for the map and for what is seen from the places; the same
  /// `kind` and map give the same work always.
  /// @errors those of get_map and RemoteViewSource::views; kFailedPrecondition: nothing is seen
  /// from any free cell.
  static Result<LoadWork> prepare(const ConnectionConfig& config,
                                  const std::string& map_id,
                                  LoadKind kind);

  const std::string& observation(std::size_t robot, std::size_t cycle) const override;
  std::string score(std::size_t robot,
                    std::size_t cycle,
                    const std::string& observation_id) const override;

  struct Place {
    Observation observation;
    ScoreRequest request;
    std::string observation_body;
    std::string score_body;  ///< without the observation's id
  };
  const std::vector<Place>& places() const { return places_; }
  const ClassTable& map_classes() const { return map_classes_; }
  /// The matrix beside the map, sent with each observation as a robot does.
  const similarity::WeightMatrix& weights() const { return weights_; }
  /// The distinct cells of all requests.
  std::vector<CellIndex> cells() const;

 private:
  LoadWork(ClassTable map_classes, similarity::WeightMatrix weights)
      : map_classes_(std::move(map_classes)), weights_(std::move(weights)) {}
  const Place& place(std::size_t robot, std::size_t cycle) const;

  ClassTable map_classes_;
  similarity::WeightMatrix weights_;
  std::vector<Place> places_;
};

}  // namespace semview::client
