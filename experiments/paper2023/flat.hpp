// SPDX-License-Identifier: Apache-2.0
/// A furnished flat: four rooms that doorways join in a ring, and what stands in them.
#pragma once

#include <cstdint>
#include <vector>

#include "experiments/paper2017/scene.hpp"
#include "semview/core/random.hpp"
#include "things.hpp"

namespace semview::paper2023 {

struct FlatConfig {
  double width_m = 9.0;  ///< inside, along x
  double depth_m = 7.0;  ///< inside, along y
  double vary_m = 0.3;   ///< either differs by up to this
  double ceiling_m = 2.5;
  double doorway_m = 0.95;  ///< doorways have no leaf
  double named = 0.7;       ///< share of things of a class that is labelled
};

/// A rectangle of the floor.
struct Area {
  double min_x_m = 0.0;
  double min_y_m = 0.0;
  double max_x_m = 0.0;
  double max_y_m = 0.0;
};

struct Flat {
  Area inside;
  double ceiling_m = 2.5;
  double named = 1.0;                       ///< as of `FlatConfig`, for what is added later
  std::vector<Area> rooms;                  ///< living room, study, kitchen, bedroom
  std::vector<Area> doorways;               ///< what must stay clear
  std::vector<paper2017::Primitive> shell;  ///< walls, floor, ceiling: object 0, no name
  std::vector<Thing> things;                ///< in order of ids
};

/// The flat of a seed as it was mapped. Equal arguments give equal flats on every machine.
Flat draw_flat(const FlatConfig& config, std::uint64_t seed);

/// A thing of a class in a room, of a size that such things have, where nothing else stands.
/// @return false: after many tries there was no room for it
bool place_thing(const Flat& flat, ThingClass label, std::size_t room, Rng& rng, Thing& thing);

/// Whether a thing fits where it is: in its room, off doorways and what else stands there.
bool fits(const Flat& flat, const Thing& thing);

/// What a camera sees of it.
paper2017::Scene scene_of(const Flat& flat);

}  // namespace semview::paper2023
