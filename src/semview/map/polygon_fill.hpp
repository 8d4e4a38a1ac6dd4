// SPDX-License-Identifier: Apache-2.0
/// Which pixels of a plan lie inside a polygon. Inside the module only.
#pragma once

#include <vector>

#include "semview/map/column_map.hpp"
#include "semview/map/map_object.hpp"

namespace semview::map::detail {

/// Pixels begin <= column < end of one row.
struct PixelRun {
  int row = 0;
  int begin = 0;
  int end = 0;
};

/// The pixels of `plan` whose centres lie inside the outline and in no hole (even-odd rule), by
/// rows from the lowest. Along the plan's own axes a centre on a left or a lower edge is inside,
/// one on a right or an upper edge is not, so that polygons that share an edge share no pixel.
/// @cost O(pixels of rows crossed by edges); tests/map/polygon_fill_test.cpp has the slow form.
std::vector<PixelRun> pixels_inside(const ObjectPolygon& polygon, const ColumnMap& plan);

}  // namespace semview::map::detail
