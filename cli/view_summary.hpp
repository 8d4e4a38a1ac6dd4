// SPDX-License-Identifier: Apache-2.0
/// What `semview view` says of a view: the engine, the pose, the share of each class.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "semview/core/hash.hpp"
#include "semview/geometry/image.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/service/site.hpp"

namespace semview::cli {

/// A cast view of either camera.
struct View {
  LabelImage labels;
  RangeImage distances_m;
  std::optional<PanoramaCamera> panorama;  ///< none: a pinhole view, distances are depths
  service::EngineChoice engine;
  double cast_ms = 0.0;
};

/// What was looked at.
struct ViewedMap {
  std::string id, name;
  Fingerprint fingerprint;
  ClassTable classes;
  double eye_z_m = 0.0;
  std::string eye_trouble;  ///< why the eye does not see the map as a robot would; empty: it does
};

/// In this process.
/// @param pose  The eye's place.
ViewedMap viewed_map(const service::Site& site, const Pose2& pose, double eye_z_m);

/// As `--json` prints it. `warning` is there if the eye does not see the map as a robot would.
nlohmann::ordered_json view_summary(const ViewedMap& map, const Pose2& pose, const View& view);

/// The same on standard output, for people.
void print_view_summary(const nlohmann::ordered_json& summary);

}  // namespace semview::cli
