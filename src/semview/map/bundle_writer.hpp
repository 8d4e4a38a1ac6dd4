// SPDX-License-Identifier: Apache-2.0
/// Writes map bundles for the importers. Inside the module only.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/map/map_class.hpp"

namespace semview::map::detail {

/// What a drawn map's file says.
struct BundleText {
  std::string id = {};  ///< "": the folder's name is one
  std::string name;
  std::string comment;  ///< one line, written first
  double resolution_m = 0.0;
  Pose2 origin;
  std::string ground_class;
  double ground_height_m = 0.0;
  std::string ceiling_class;  ///< "" for an open top
  double ceiling_height_m = 0.0;
  Rgb outside;
  std::vector<MapClass> classes;
  std::string objects = {};  ///< the text of `objects.geojson`; "" for none
};

/// The text of a `map.yaml` that names `labels.png` and `occupancy.png`.
std::string map_yaml(const BundleText& text);

/// Makes `directory` with map.yaml, labels.png, occupancy.png and perhaps
/// objects.geojson, then loads it. If the folder's
/// name is no id, the map gets one made of it: "Ros Map" becomes ros_map.
/// @errors kAlreadyExists: there is a map.yaml already; kUnavailable: cannot be written; and those
/// of `load_map`: the files stay for a look, then.
Status write_bundle(const BundleText& text,
                    const RgbImage& labels,
                    const std::filesystem::path& directory);

}  // namespace semview::map::detail
