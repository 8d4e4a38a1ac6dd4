// SPDX-License-Identifier: Apache-2.0
/// The colours in which people see classes.
#pragma once

#include <array>

#include "semview/geometry/image.hpp"
#include "semview/semantics/class_table.hpp"

namespace semview::picture {

/// A colour for each of the 256 ids. `kNoHit` is near white, `kUnknown` mid grey.
class ClassPalette {
 public:
  /// Indoor classes that are known by name get quiet, fitting colours (wall, floor, door, …);
  /// others get well-separated ones by their place in the table.
  static ClassPalette for_classes(const ClassTable& classes);

  const Rgb& operator[](ClassId id) const { return colours_[id]; }
  void set(ClassId id, const Rgb& colour) { colours_[id] = colour; }

 private:
  std::array<Rgb, 256> colours_{};
};

}  // namespace semview::picture
