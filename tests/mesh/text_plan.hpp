// SPDX-License-Identifier: Apache-2.0
/// Tiny maps drawn with characters.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "semview/map/column_map.hpp"

namespace semview::map {

/// A map from rows of characters, top row first. A space is outside; every other character needs a
/// profile.
inline ColumnMap plan_from_text(const std::vector<std::string>& rows,
                                const std::map<char, ColumnProfile>& profile_of,
                                double resolution_m = 1.0) {
  ColumnMap map;
  map.resolution_m = resolution_m;
  map.profiles.push_back({.outside = true, .slabs = {}});
  std::map<char, std::uint8_t> index{{' ', std::uint8_t{0}}};
  for (const auto& [character, profile] : profile_of) {
    index[character] = static_cast<std::uint8_t>(map.profiles.size());
    map.profiles.push_back(profile);
  }
  map.profile_of_pixel =
      Image<std::uint8_t>(static_cast<int>(rows.size()), static_cast<int>(rows.at(0).size()));
  for (int r = 0; r < map.rows(); ++r) {
    for (int c = 0; c < map.columns(); ++c) {
      map.profile_of_pixel.at(r, c) =
          index.at(rows[static_cast<std::size_t>(r)].at(static_cast<std::size_t>(c)));
    }
  }
  return map;
}

}  // namespace semview::map
