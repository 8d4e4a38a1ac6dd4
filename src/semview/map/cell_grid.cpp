// SPDX-License-Identifier: Apache-2.0
#include "semview/map/cell_grid.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "semview/core/check.hpp"

namespace semview::map {
namespace {

/// 0.5 m between centres, in cells.
constexpr int kViewRadius_cells = 5;

struct Offset {
  int dx = 0;
  int dy = 0;
};

/// All offsets within the radius: nearest first, then lowest iy, then lowest ix.
std::vector<Offset> make_view_offsets() {
  std::vector<Offset> offsets;
  for (int dy = -kViewRadius_cells; dy <= kViewRadius_cells; ++dy) {
    for (int dx = -kViewRadius_cells; dx <= kViewRadius_cells; ++dx) {
      if (dx * dx + dy * dy <= kViewRadius_cells * kViewRadius_cells) offsets.push_back({dx, dy});
    }
  }
  const auto squared = [](const Offset& o) { return o.dx * o.dx + o.dy * o.dy; };
  std::stable_sort(offsets.begin(), offsets.end(), [&](const Offset& l, const Offset& r) {
    return squared(l) < squared(r);
  });
  return offsets;
}

}  // namespace

CellGrid::CellGrid(CellIndex minimum, int columns, int rows, std::vector<std::uint8_t> facts)
    : minimum_(minimum), columns_(columns), rows_(rows), facts_(std::move(facts)) {
  SEMVIEW_CHECK(columns >= 0 && rows >= 0);
  SEMVIEW_CHECK(facts_.size() ==
                static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  free_count_ = static_cast<std::size_t>(std::count_if(
      facts_.begin(), facts_.end(), [](std::uint8_t fact) { return (fact & kFree) != 0; }));
}

bool CellGrid::contains(const CellIndex& cell) const {
  const std::int64_t x = std::int64_t{cell.ix} - minimum_.ix;
  const std::int64_t y = std::int64_t{cell.iy} - minimum_.iy;
  return x >= 0 && x < columns_ && y >= 0 && y < rows_;
}

std::size_t CellGrid::index(const CellIndex& cell) const {
  return static_cast<std::size_t>(cell.iy - minimum_.iy) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(cell.ix - minimum_.ix);
}

std::uint8_t CellGrid::facts(const CellIndex& cell) const {
  return contains(cell) ? facts_[index(cell)] : std::uint8_t{0};
}

std::optional<CellIndex> CellGrid::view_cell(const CellIndex& cell) const {
  static const std::vector<Offset> kOffsets = make_view_offsets();
  for (const Offset& offset : kOffsets) {
    const CellIndex candidate{cell.ix + offset.dx, cell.iy + offset.dy};
    if (has_eye(candidate)) return candidate;
  }
  return std::nullopt;
}

bool CellGrid::any_view() const {
  return std::ranges::any_of(
      facts_, [](std::uint8_t facts) { return (facts & (kFree | kHasEye)) == (kFree | kHasEye); });
}

std::vector<CellIndex> CellGrid::free_cells() const {
  std::vector<CellIndex> cells;
  cells.reserve(free_count_);
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      const CellIndex cell{minimum_.ix + x, minimum_.iy + y};
      if (is_free(cell)) cells.push_back(cell);
    }
  }
  return cells;
}

bool CellGrid::can_step(const CellIndex& from, const CellIndex& to) const {
  if (!is_free(from) || !is_free(to)) return false;
  const int dx = to.ix - from.ix;
  const int dy = to.iy - from.iy;
  if (dx * dx + dy * dy != 1) return false;
  const std::uint8_t open = dx != 0 ? kEastOpen : kNorthOpen;
  return (facts(std::min(from, to)) & open) != 0;
}

std::vector<CellIndex> CellGrid::flood(const CellIndex& start, std::vector<bool>& seen) const {
  std::vector<CellIndex> cells{start};
  seen[index(start)] = true;
  for (std::size_t next = 0; next < cells.size(); ++next) {
    const CellIndex from = cells[next];
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const CellIndex to{from.ix + dx, from.iy + dy};
      if (!can_step(from, to) || seen[index(to)]) continue;
      seen[index(to)] = true;
      cells.push_back(to);
    }
  }
  return cells;
}

std::vector<CellIndex> CellGrid::reachable_from(const CellIndex& start) const {
  if (!is_free(start)) return {};
  std::vector<bool> seen(facts_.size(), false);
  std::vector<CellIndex> cells = flood(start, seen);
  std::sort(cells.begin(), cells.end());
  return cells;
}

std::vector<GridComponent> CellGrid::components() const {
  std::vector<GridComponent> parts;
  std::vector<bool> seen(facts_.size(), false);
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      const CellIndex cell{minimum_.ix + x, minimum_.iy + y};
      if (!is_free(cell) || seen[index(cell)]) continue;
      parts.push_back({cell, flood(cell, seen).size()});
    }
  }
  std::stable_sort(parts.begin(), parts.end(), [](const GridComponent& l, const GridComponent& r) {
    return l.cells > r.cells;
  });
  return parts;
}

}  // namespace semview::map
