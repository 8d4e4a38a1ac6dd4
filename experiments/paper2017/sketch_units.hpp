// SPDX-License-Identifier: Apache-2.0
/// Where `evaluate sketches --resume` finds what was done: a file a sketch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "semview/core/result.hpp"
#include "sketch_drives.hpp"

namespace semview::paper2017 {

/// The sketches of some settings, by worlds.
class SketchUnits {
 public:
  struct Unit {
    std::uint64_t world = 1;
    int sketch = 1;  ///< from 1
    std::filesystem::path file;
    bool finished = false;
  };

  /// @param described  all that drives depend on but worlds and numbers of sketches
  /// @errors kFailedPrecondition: `settings.out` holds results and `settings.resume` is not set, or
  /// files of other settings, or damaged ones.
  static Result<SketchUnits> open(const SketchSettings& settings, const std::string& described);

  std::span<const Unit> units() const { return units_; }

  /// @threads each unit by one
  Status keep(const Unit& unit, std::span<const SketchDrive> drives) const;

  /// All drives, as the files have them.
  Result<std::vector<SketchDrive>> read_all() const;

 private:
  std::string first_line_;
  std::vector<Unit> units_;
};

}  // namespace semview::paper2017
