// SPDX-License-Identifier: Apache-2.0
/// What came out on sketches, as a table.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sketch_drives.hpp"

namespace semview::paper2017 {

/// The drives of one method from one kind of start.
struct SketchSummary {
  std::string method;
  Start start = Start::kLocal;
  std::size_t drives = 0;
  std::size_t stops = 0;
  double right_room_share = 0.0;   ///< of the stops
  double worst_world_share = 0.0;  ///< the same in the world where it is least
  double late_share = 0.0;         ///< the same from stop 4 on, when an unknown start is over
  double right_order_share = 0.0;  ///< of the drives
  double mean_error_m = 0.0;       ///< from the robot's place in the sketch
  double median_error_m = 0.0;
};

/// By the order in which methods and starts first occur.
std::vector<SketchSummary> summarize(std::span<const SketchDrive> drives);

/// A table in Markdown.
std::string to_markdown(std::span<const SketchSummary> summaries);

}  // namespace semview::paper2017
