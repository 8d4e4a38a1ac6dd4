// SPDX-License-Identifier: Apache-2.0
/// From a layout to the solids that the experiment's camera sees.
#pragma once

#include "layout.hpp"
#include "scene.hpp"

namespace semview::paper2017 {

/// Everything that is really there: desks as slabs on legs, chairs with seat, back and stem, doors
/// as leaves at their angle, windows with frames, radiators, lamps, pictures. Objects are numbered
/// by what belongs together: 0 is floor, ceiling and walls.
Scene build_scene(const Layout& layout);

/// A person standing at a place, as the object after all others.
std::vector<Primitive> person(double x_m, double y_m, double height_m, std::int32_t object);

}  // namespace semview::paper2017
