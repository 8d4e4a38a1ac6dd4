// SPDX-License-Identifier: Apache-2.0
#include "semview/semantics/class_table.hpp"

#include <algorithm>
#include <utility>

#include "semview/core/check.hpp"

namespace semview {

ClassTable::ClassTable(std::vector<std::string> names) : names_(std::move(names)) {
  SEMVIEW_CHECK(names_.size() <= kMaxClasses);
}

std::string_view ClassTable::name(ClassId id) const {
  if (id == kNoHit) return "none";
  if (id > size()) return "unknown";
  return names_[id - 1U];
}

std::optional<ClassId> ClassTable::id(std::string_view name) const {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) return {};
  return static_cast<ClassId>(found - names_.begin() + 1);
}

}  // namespace semview
