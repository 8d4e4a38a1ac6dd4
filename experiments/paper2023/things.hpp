// SPDX-License-Identifier: Apache-2.0
/// What stands in a furnished flat: twelve classes of objects and the solids they are made of.
#pragma once

#include <cstdint>
#include <vector>

#include "experiments/paper2017/scene.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/semantics/class_table.hpp"

namespace semview::paper2023 {

/// Values are ids of `thing_classes()`.
enum class ThingClass : ClassId {
  kChair = 1,
  kSofa,
  kBed,
  kTable,
  kTelevision,
  kPlant,
  kRefrigerator,
  kSink,
  kCabinet,
  kShelf,
  kLamp,
  kBox,
};

inline constexpr int kThingClassCount = 12;

/// Objects alone, as a detector names them: walls, floor and ceiling have no name.
const ClassTable& thing_classes();

/// One object. Its long side is along x of its pose; those that stand at a wall have it behind
/// them, at -y.
struct Thing {
  std::int32_t id = 0;  ///< from 1; the same in all sessions of a flat
  ThingClass shape = ThingClass::kBox;
  ThingClass name = ThingClass::kBox;  ///< what it is called; another class after a change of looks
  bool named = true;                   ///< or of no class that anybody labels
  Pose2 map_from_thing;
  double length_m = 0.4;
  double width_m = 0.4;
  double height_m = 0.4;
  std::size_t room = 0;
};

/// What its outside is made of.
std::vector<paper2017::Primitive> solids_of(const Thing& thing);

}  // namespace semview::paper2023
