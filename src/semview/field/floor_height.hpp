// SPDX-License-Identifier: Apache-2.0
/// Where the floor of a mapped room lies.
#pragma once

#include "semview/map/triangle_mesh.hpp"

namespace semview::field {

/// Height of the floor: the mean of the lowest level, `level_m` thick, that has at least a quarter
/// of the largest one's area of triangles that lie level and face up; only those of class `floor`
/// unless it is `kNoHit`. Without any the lowest vertex.
double floor_height_m(const map::TriangleMesh& mesh, ClassId floor, double level_m);

}  // namespace semview::field
