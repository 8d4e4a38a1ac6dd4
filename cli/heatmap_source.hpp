// SPDX-License-Identifier: Apache-2.0
/// Where `semview heatmap` gets its values: this process or a server.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "client/lib/remote_heat_map.hpp"
#include "model_options.hpp"
#include "observation_option.hpp"
#include "semview/core/hash.hpp"
#include "semview/picture/plan.hpp"
#include "site_options.hpp"

namespace semview::cli {

/// What is compared with which map.
struct HeatMapInputs {
  SiteOptions site;
  std::string server;  ///< empty: in this process
  ObservationOption observation;
  std::string weights;                       ///< of views
  std::vector<std::string> models{"views"};  ///< `views` alone, or models of depth
  ModelOptions depth;                        ///< their settings; its `model` is not looked at
  std::optional<double> heading_yaw_rad;     ///< of depth in this process: the only one tried
};

/// A heat map, and the map that it is of.
struct HeatMapOfMap {
  client::HeatMapAnswer answer;
  std::size_t cells = 0;  ///< free ones
  std::string id, name;
  Fingerprint fingerprint;
  std::string engine, engine_reason;
  std::optional<picture::Plan> plan;  ///< none of a mesh or of a server's map
  std::string model;
  /// Where the eye was, or of depth the robot, if a run log with ground truth says so.
  std::optional<Pose2> truth;
};

/// One a model, the same values either way.
/// @errors those of opening the inputs, of `similarity::heat_map` and of the server.
Result<std::vector<HeatMapOfMap>> heat_maps_of(const HeatMapInputs& inputs,
                                               const client::HeatMapQuestion& question);

}  // namespace semview::cli
