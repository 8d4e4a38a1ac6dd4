// SPDX-License-Identifier: Apache-2.0
/// One entry of a map's class list. See docs/formats/map_bundle.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "semview/geometry/image.hpp"

namespace semview::map {

/// A class as the map's file describes it; its id is its place in the list, from 1.
struct MapClass {
  std::string name;
  std::optional<Rgb> color;   ///< its colour in the drawing; none: never drawn
  double min_height_m = 0.0;  ///< lower face in frame `map`
  double max_height_m = 0.0;  ///< upper face; both at the ground: paint on the ground
  std::string above;  ///< class from `max_height_m` to that class's own upper face; "" for nothing
  std::string below;  ///< class from that class's own lower face to `min_height_m`; "" for nothing
  bool passable = false;  ///< a robot may stand there although a slab is in its way (an open door)
  double movable = 0.0;   ///< in [0, 1]: how likely it stands elsewhere than drawn
  std::vector<std::string> aliases;  ///< other names for it in vocabularies

  bool operator==(const MapClass&) const = default;
};

}  // namespace semview::map
