// SPDX-License-Identifier: Apache-2.0
/// What is wrong with a map: where, what, and what would be right.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/map/column_map.hpp"

namespace semview::map {

enum class Severity {
  kError,    ///< the map cannot be used
  kWarning,  ///< it can be used, but may not be what its author meant
};

struct MapProblem {
  Severity severity = Severity::kError;
  ErrorCode code = ErrorCode::kInvalidArgument;
  std::filesystem::path file;
  int line = 0;                     ///< 1-based; 0: none
  std::optional<PixelIndex> pixel;  ///< the first one concerned
  std::string message;              ///< what is wrong
  std::string remedy;               ///< what would be right
};

/// `map.yaml:12: error: what; remedy` or `labels.png: pixel (x 3, y 7): error: what; remedy`.
std::string to_string(const MapProblem& problem);

/// Everything found, in the order of the files.
struct MapReport {
  std::vector<MapProblem> problems;

  bool has_errors() const;
  std::size_t count(Severity severity) const;
};

}  // namespace semview::map
