// SPDX-License-Identifier: Apache-2.0
/// What an object has to be, given the class list. Inside the module only.
#pragma once

#include <filesystem>
#include <vector>

#include "semview/map/map_file.hpp"
#include "semview/map/map_object.hpp"
#include "semview/map/map_problem.hpp"

namespace semview::map::detail {

/// An object with the class that it makes of the pixels in it.
struct ObjectClass {
  MapObject object;
  MapClass own;  ///< the list's, with the object's heights, `above` and `below`
};

/// Adds to `report` what is wrong between `objects`, of the file at `path`, and the class list:
/// names, heights, references; and warns of heights that ground or ceiling cut. Those with an error
/// are left out.
std::vector<ObjectClass> check_objects(std::vector<MapObject> objects,
                                       const std::filesystem::path& path,
                                       const MapFile& file,
                                       MapReport& report);

}  // namespace semview::map::detail
