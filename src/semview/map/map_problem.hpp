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

/// A feature of a GeoJSON file.
struct Feature {
  int number = 0;    ///< from 1, as they stand in the file
  std::string name;  ///< "": it has none
};

struct MapProblem {
  Severity severity = Severity::kError;
  ErrorCode code = ErrorCode::kInvalidArgument;
  std::filesystem::path file;
  int line = 0;                     ///< 1-based; 0: none
  std::optional<PixelIndex> pixel;  ///< the first one concerned
  std::optional<Feature> feature;
  std::string message;  ///< what is wrong
  std::string remedy;   ///< what would be right
};

/// Where a problem lies: `map.yaml:12`, `labels.png: pixel (x 3, y 7)`, `objects.geojson: feature 2
/// (sill)`, or the file alone.
std::string place_of(const MapProblem& problem);

/// `map.yaml:12: error: what; remedy` or `labels.png: pixel (x 3, y 7): error: what; remedy`.
std::string to_string(const MapProblem& problem);

/// A problem with a whole file.
MapProblem file_problem(Severity severity,
                        const std::filesystem::path& file,
                        std::string message,
                        std::string remedy = {});
/// A problem in a line of a file.
MapProblem line_problem(Severity severity,
                        const std::filesystem::path& file,
                        int line,
                        std::string message,
                        std::string remedy = {});
/// An error from reading `file`; a place at the front of its message (`file:12: …`) becomes the
/// problem's own.
MapProblem problem_of(const std::filesystem::path& file, const Error& error);

/// Everything found; `sort_by_place` gives it an order to read.
struct MapReport {
  std::vector<MapProblem> problems;

  bool has_errors() const { return count(Severity::kError) > 0; }
  std::size_t count(Severity severity) const;
};

/// By file, then line, then feature, then pixel row and column; what concerns a whole file comes
/// after its places.
void sort_by_place(MapReport& report);

/// The first error of a report that has one, as a value to return.
Error first_error(const MapReport& report);

}  // namespace semview::map
