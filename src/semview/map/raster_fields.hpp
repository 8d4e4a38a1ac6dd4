// SPDX-License-Identifier: Apache-2.0
/// What a ROS map_server file says of its image. Inside the module only.
#pragma once

#include "semview/map/map_file.hpp"
#include "semview/map/yaml_fields.hpp"

namespace semview::map::detail {

/// Reads `image`, `resolution` and `origin` into `file`, and checks what only ROS tools use.
void read_raster(MapFile& file, YamlFields& fields);

}  // namespace semview::map::detail
