// SPDX-License-Identifier: Apache-2.0
/// From a layout to the plan that somebody drew of it by hand: a map bundle.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "layout.hpp"
#include "semview/core/result.hpp"

namespace semview::paper2017 {

/// Which of the paper's ten classes the plan has (section IV-A, experiment 5).
enum class ClassSubset {
  kAll,
  kConstructionExtended,  ///< wall, dividing wall, floor, door, window
  kConstructionBasic,     ///< wall, dividing wall, floor
  kFurniture,             ///< table, chair, cupboard, sideboard, sink
};

/// "all", "extended", "basic" or "furniture".
std::string_view name(ClassSubset classes);

struct PlanConfig {
  double resolution_m = 0.02;
  double hand_error_m = 0.04;  ///< σ of where a line is drawn
  /// Wall above doors and above and below windows. The paper's maps have one interval of height a
  /// class and nothing there.
  bool stacked = false;
  ClassSubset classes = ClassSubset::kAll;
};

/// The ten names of section IV-A.
const std::vector<std::string>& map_class_names();

/// Whether a plan of this subset has the class.
bool has_class(ClassSubset subset, const std::string& name);

/// Writes `map.yaml` and `labels.png` to `directory`. The same seed gives the same lines whatever
/// `config` leaves out.
/// @errors kUnavailable: cannot be written.
Status draw_plan(const Layout& layout,
                 const PlanConfig& config,
                 std::uint64_t seed,
                 const std::filesystem::path& directory);

}  // namespace semview::paper2017
