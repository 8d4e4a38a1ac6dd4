// SPDX-License-Identifier: Apache-2.0
/// Semantic classes and their ids.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace semview {

/// 1..254 in the order of a class table.
using ClassId = std::uint8_t;

inline constexpr ClassId kNoHit = 0;  ///< the ray met nothing
inline constexpr ClassId kUnknown =
    255;  ///< observations only: not seen or undecided, never scored
inline constexpr int kMaxClasses = 254;

/// Class names in id order: the first has id 1.
///
/// What a map and an observation share. Colours and heights belong to the map's file.
class ClassTable {
 public:
  ClassTable() = default;
  /// `names` must be unique, non-empty and at most `kMaxClasses`: its reader has checked that.
  explicit ClassTable(std::vector<std::string> names);

  int size() const { return static_cast<int>(names_.size()); }
  std::span<const std::string> names() const { return names_; }
  /// The name of `id`; "none" for `kNoHit`, "unknown" for `kUnknown` and ids past the table.
  std::string_view name(ClassId id) const;
  std::optional<ClassId> id(std::string_view name) const;

  bool operator==(const ClassTable&) const = default;

 private:
  std::vector<std::string> names_;
};

}  // namespace semview
