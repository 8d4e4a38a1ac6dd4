// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/pose_groups.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "semview/core/check.hpp"

namespace semview::similarity {
namespace {

/// A pose by a number that orders it.
struct Entry {
  std::uint64_t key = 0;
  std::uint32_t pose = 0;
};

/// Below this many entries comparing is quicker than counting digits.
constexpr std::size_t kFewEntries = 200;
constexpr int kDigitBits = 8;

/// Sorts by key; entries with equal keys stay in order of their poses, in which they come. Digit by
/// digit from the lowest: comparisons of random keys are mispredicted every other time.
void sort_entries(std::vector<Entry>& entries, std::uint64_t largest_key) {
  if (entries.size() < kFewEntries) {
    std::ranges::sort(entries, [](const Entry& l, const Entry& r) {
      return l.key != r.key ? l.key < r.key : l.pose < r.pose;
    });
    return;
  }
  std::vector<Entry> sorted(entries.size());
  for (int shift = 0; shift < static_cast<int>(std::bit_width(largest_key)); shift += kDigitBits) {
    const auto digit = [shift](const Entry& entry) {
      return static_cast<std::uint8_t>(entry.key >> static_cast<unsigned>(shift));
    };
    std::array<std::uint32_t, std::size_t{1} << kDigitBits> place{};
    for (const Entry& entry : entries) ++place[digit(entry)];
    std::uint32_t before = 0;
    for (std::uint32_t& count : place) before += std::exchange(count, before);
    for (const Entry& entry : entries) sorted[place[digit(entry)]++] = entry;
    entries.swap(sorted);
  }
}

/// Numbers cells row by row from the lowest ones that are there: few bits, few digits to sort by.
class CellNumbers {
 public:
  explicit CellNumbers(std::span<const CellIndex> cells) {
    std::int32_t right = std::numeric_limits<std::int32_t>::min();
    for (const CellIndex& cell : cells) {
      left_ = std::min(left_, cell.ix);
      lowest_ = std::min(lowest_, cell.iy);
      right = std::max(right, cell.ix);
    }
    width_ = static_cast<std::uint64_t>(std::int64_t{right} - left_ + 1);
  }

  /// Below 2^51: no coordinate of the grid has more than 25 bits.
  std::uint64_t number(const CellIndex& cell) const {
    return static_cast<std::uint64_t>(std::int64_t{cell.iy} - lowest_) * width_ +
           static_cast<std::uint64_t>(std::int64_t{cell.ix} - left_);
  }

 private:
  std::int32_t left_ = std::numeric_limits<std::int32_t>::max();
  std::int32_t lowest_ = std::numeric_limits<std::int32_t>::max();
  std::uint64_t width_ = 1;
};

/// @errors those of `group_by_cell`
Result<std::vector<CellIndex>> cells_of(std::span<const Pose2> poses, const ViewCell& view_cell) {
  std::vector<CellIndex> cells(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose2& pose = poses[i];
    const std::optional<CellIndex> cell = PoseGrid::cell(pose.x_m, pose.y_m);
    if (!cell || !std::isfinite(pose.yaw_rad)) {
      return fail(Error{ErrorCode::kInvalidArgument,
                        fmt::format("pose {} ({:g}, {:g}, {:g}) is not finite or not on the grid",
                                    i,
                                    pose.x_m,
                                    pose.y_m,
                                    pose.yaw_rad),
                        "poses"});
    }
    cells[i] = view_cell ? view_cell(*cell) : *cell;
  }
  return cells;
}

}  // namespace

Result<PoseGroups> group_by_cell(std::span<const Pose2> poses,
                                 HeadingMode mode,
                                 const ViewCell& view_cell) {
  SEMVIEW_CHECK(poses.size() < std::numeric_limits<std::uint32_t>::max());
  SEMVIEW_TRY(const std::vector<CellIndex> cells, cells_of(poses, view_cell));
  PoseGroups groups;
  if (mode == HeadingMode::kAsGiven) {
    groups.headings.reserve(poses.size());
    for (const Pose2& pose : poses) {
      groups.headings.push_back(static_cast<std::uint8_t>(PoseGrid::heading(pose.yaw_rad)));
    }
  }
  const CellNumbers numbers(cells);
  std::vector<Entry> entries(poses.size());
  std::uint64_t largest = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    std::uint64_t key = numbers.number(cells[i]);
    if (mode == HeadingMode::kAsGiven) key = key * PoseGrid::kHeadings + groups.headings[i];
    entries[i] = {key, static_cast<std::uint32_t>(i)};
    largest = std::max(largest, key);
  }
  sort_entries(entries, largest);
  groups.order.reserve(poses.size());
  for (const Entry& entry : entries) {
    const CellIndex& cell = cells[entry.pose];
    if (groups.cells.empty() || groups.cells.back() != cell) {
      groups.begins.push_back(static_cast<std::uint32_t>(groups.order.size()));
      groups.cells.push_back(cell);
    }
    groups.order.push_back(entry.pose);
  }
  groups.begins.push_back(static_cast<std::uint32_t>(groups.order.size()));
  return groups;
}

}  // namespace semview::similarity
