// SPDX-License-Identifier: Apache-2.0
/// Where `semview heatmap` gets its values: this process or a server.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "client/lib/remote_heat_map.hpp"
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
  std::string weights;
};

/// A heat map, and the map that it is of.
struct HeatMapOfMap {
  client::HeatMapAnswer answer;
  std::size_t cells = 0;  ///< free ones
  std::string id, name;
  Fingerprint fingerprint;
  std::string engine, engine_reason;
  std::optional<picture::Plan> plan;  ///< none of a mesh or of a server's map
};

/// The same values either way.
/// @errors those of opening the inputs, of `similarity::heat_map` and of the server.
Result<HeatMapOfMap> heat_map_of(const HeatMapInputs& inputs,
                                 const client::HeatMapQuestion& question);

}  // namespace semview::cli
