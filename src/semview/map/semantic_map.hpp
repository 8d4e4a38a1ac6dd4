// SPDX-License-Identifier: Apache-2.0
/// A loaded map, drawn or meshed, ready to be cast.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "semview/core/hash.hpp"
#include "semview/core/result.hpp"
#include "semview/map/column_map.hpp"
#include "semview/map/map_class.hpp"
#include "semview/map/triangle_mesh.hpp"
#include "semview/semantics/class_table.hpp"

namespace semview::map {

/// The surfaces of a mesh map, in frame `map`, labels as ids of the map's classes.
struct MeshGeometry {
  TriangleMesh mesh;
  std::filesystem::path file;
};

/// What `objects.geojson` has put into a plan. The columns hold it already: this is for people, and
/// for writing the map again.
struct PlanObjects {
  std::size_t features = 0;  ///< in the file
  /// The profiles of the columns after those of the classes: the class of each with the heights,
  /// `above` and `below` that it has there.
  std::vector<MapClass> profiles;
};

/// Everything about one map. Immutable once loaded; shared as `shared_ptr<const SemanticMap>`.
struct SemanticMap {
  std::string id;                   ///< [a-z0-9_-]+
  std::string name;                 ///< for people
  std::filesystem::path directory;  ///< the folder of its file
  std::filesystem::path drawing;    ///< the picture of a drawn map; of a mesh map empty
  ClassTable classes;
  std::vector<MapClass> class_details;  ///< in the order of `classes`
  double ground_height_m = 0.0;
  ClassId ground_label = kNoHit;  ///< `kNoHit` for a mesh without a class for it
  std::optional<Ceiling> ceiling;
  std::variant<ColumnMap, MeshGeometry> geometry;
  PlanObjects objects;
  Fingerprint fingerprint;
  /// The file of the semantic volume that a fused map is the surface of; of other maps empty.
  std::filesystem::path volume;

  const ColumnMap* columns() const { return std::get_if<ColumnMap>(&geometry); }
  const MeshGeometry* mesh() const { return std::get_if<MeshGeometry>(&geometry); }
};

struct LoadOptions {
  /// Takes a pixel whose colour is no class's to be of the class with the nearest colour (in sRGB)
  /// close by, for drawings with smoothed edges; by default such a pixel is an error.
  bool nearest_colour = false;
};

/// Loads a map from a bundle's folder, its `map.yaml`, or a bare `.glb`.
/// @errors kNotFound: no such file; kInvalidArgument: the first error that `check_map` lists;
/// kUnimplemented: a newer format; kResourceExhausted: above a limit of docs/formats/map_bundle.md.
Result<SemanticMap> load_map(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace semview::map
