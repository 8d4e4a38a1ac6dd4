// SPDX-License-Identifier: Apache-2.0
#include "sketch_report.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace semview::paper2017 {
namespace {

/// The first of them is the third step: a robot that knows nothing has looked three times.
constexpr std::size_t kFirstLateStop = 3;

struct Tally {
  std::size_t stops = 0;
  std::size_t right = 0;

  void add(const SketchStop& stop) {
    ++stops;
    right += stop.found_room == stop.true_room ? 1 : 0;
  }
  double share() const {
    return stops == 0 ? 0.0 : static_cast<double>(right) / static_cast<double>(stops);
  }
};

SketchSummary summary_of(std::span<const SketchDrive* const> drives) {
  SketchSummary summary;
  summary.method = drives.front()->method;
  summary.start = drives.front()->start;
  Tally all;
  Tally late;
  std::map<std::uint64_t, Tally> worlds;
  std::vector<double> errors_m;
  for (const SketchDrive* drive : drives) {
    ++summary.drives;
    summary.right_order_share += in_right_order(*drive) ? 1.0 : 0.0;
    for (std::size_t i = 0; i < drive->stops.size(); ++i) {
      const SketchStop& stop = drive->stops[i];
      all.add(stop);
      worlds[drive->world].add(stop);
      if (i >= kFirstLateStop) late.add(stop);
      errors_m.push_back(distance_m(stop.estimate, stop.true_place));
      summary.mean_error_m += errors_m.back();
    }
  }
  summary.stops = all.stops;
  summary.right_room_share = all.share();
  summary.late_share = late.share();
  summary.worst_world_share = std::ranges::min_element(worlds, {}, [](const auto& world) {
                                return world.second.share();
                              })->second.share();
  summary.right_order_share /= static_cast<double>(summary.drives);
  summary.mean_error_m /= static_cast<double>(errors_m.size());
  const auto middle = errors_m.begin() + static_cast<std::ptrdiff_t>(errors_m.size() / 2);
  std::ranges::nth_element(errors_m, middle);
  summary.median_error_m = *middle;
  return summary;
}

}  // namespace

std::vector<SketchSummary> summarize(std::span<const SketchDrive> drives) {
  std::vector<std::vector<const SketchDrive*>> groups;
  for (const SketchDrive& drive : drives) {
    const auto same = std::ranges::find_if(groups, [&](const auto& group) {
      return group.front()->method == drive.method && group.front()->start == drive.start;
    });
    if (same == groups.end()) {
      groups.push_back({&drive});
    } else {
      same->push_back(&drive);
    }
  }
  std::vector<SketchSummary> summaries;
  for (const auto& group : groups) {
    summaries.push_back(summary_of(group));
  }
  return summaries;
}

std::string to_markdown(std::span<const SketchSummary> summaries) {
  std::string text =
      "| method | start | drives | right room | from image 4 | worst world | rooms in order | mean "
      "error | median |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const SketchSummary& one : summaries) {
    text += fmt::format(
        "| {} | {} | {} | {:.1f} % | {:.1f} % | {:.1f} % | {:.0f} % | {:.2f} m | {:.2f} m |\n",
        one.method,
        one.start == Start::kLocal ? "known" : "unknown",
        one.drives,
        100.0 * one.right_room_share,
        100.0 * one.late_share,
        100.0 * one.worst_world_share,
        100.0 * one.right_order_share,
        one.mean_error_m,
        one.median_error_m);
  }
  return text;
}

}  // namespace semview::paper2017
