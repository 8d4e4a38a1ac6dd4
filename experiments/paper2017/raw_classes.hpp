// SPDX-License-Identifier: Apache-2.0
/// What the experiment's camera can name: 22 classes of ADE20K, not those of the map.
#pragma once

#include "semview/semantics/class_table.hpp"

namespace semview::paper2017 {

/// Values are ids of `raw_classes()`. "Dividing wall", "cupboard" and "sideboard", which the map
/// has, are missing on purpose: a network trained on ADE20K has no such names.
enum class RawClass : ClassId {
  kWall = 1,
  kFloor,
  kCeiling,
  kDoor,
  kWindowpane,
  kTable,
  kDesk,
  kSwivelChair,
  kChair,
  kCabinet,
  kShelf,
  kChestOfDrawers,
  kSink,
  kPainting,
  kPoster,
  kLight,
  kCurtain,
  kRadiator,
  kMonitor,
  kBox,
  kPlant,
  kPerson,
};

inline constexpr int kRawClassCount = 22;

/// Their names in ADE20K, in id order.
const ClassTable& raw_classes();

}  // namespace semview::paper2017
