// SPDX-License-Identifier: Apache-2.0
/// `map.yaml` as read, before its images are. Inside the module only.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "semview/geometry/image.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/map/map_class.hpp"
#include "semview/map/map_problem.hpp"

namespace semview::map::detail {

/// The newest `format` that this reader knows.
inline constexpr int kMapFormat = 1;

/// A text value and the line it stands in; line 0: absent. The text of a file name that the report
/// refuses is empty.
struct TextField {
  std::string text;
  int line = 0;
};

/// `ground:` or `ceiling:`.
struct LevelField {
  TextField class_name;
  double height_m = 0.0;
  bool has_height = false;
  int line = 0;
};

/// An entry of the class list.
struct ClassField {
  MapClass value;
  bool has_heights = false;
  bool heights_refused = false;  ///< the report says already why there are none
  int line = 0;
  int color_line = 0;
  int height_line = 0;
  int above_line = 0;
  int below_line = 0;
};

struct MapFile {
  std::filesystem::path path;
  std::string id;
  std::string name;
  TextField labels;  ///< either this or `mesh`
  TextField mesh;
  TextField objects;  ///< a GeoJSON file; only beside `labels`
  TextField volume;   ///< the semantic volume that the mesh is the surface of; may be absent
  TextField image;    ///< the occupancy image for ROS tools; may be absent
  double resolution_m = 0.0;
  Pose2 origin;
  LevelField ground;
  std::optional<LevelField> ceiling;
  Rgb outside;
  int outside_line = 0;                ///< 0: absent, black
  std::filesystem::path classes_path;  ///< the file that holds the list, `path` itself mostly
  std::vector<ClassField> classes;
  // False if the report says already why: what follows from it is not reported again.
  bool has_classes = false;
  bool all_named = true;
  bool all_coloured = true;

  bool is_mesh() const { return mesh.line > 0; }
};

/// Reads `map.yaml`, and the class file that it may name, and adds all that is wrong in them to
/// `report`. Values that could not be read keep their defaults; none if there is no block
/// `semview` to speak of.
std::optional<MapFile> read_map_file(const std::filesystem::path& path, MapReport& report);

}  // namespace semview::map::detail
