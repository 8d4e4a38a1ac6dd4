// SPDX-License-Identifier: Apache-2.0
/// The 10 cm / 3° grid on which views are cached. The only way from a pose to a grid key.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <optional>

#include "semview/geometry/pose2.hpp"

namespace semview {

/// A cell of the grid in frame `map`: [ix·0.1, (ix+1)·0.1) × [iy·0.1, (iy+1)·0.1).
struct CellIndex {
  std::int32_t ix = 0;
  std::int32_t iy = 0;

  /// Row by row: iy first.
  friend std::strong_ordering operator<=>(const CellIndex& l, const CellIndex& r) {
    return l.iy != r.iy ? l.iy <=> r.iy : l.ix <=> r.ix;
  }
  bool operator==(const CellIndex&) const = default;
};

/// A cell and one of its 120 headings.
struct GridKey {
  CellIndex cell;
  int heading = 0;  ///< in [0, 120); the yaw is heading · 3°

  bool operator==(const GridKey&) const = default;
};

/// The grid in frame `map`, from its (0, 0) and along its axes whatever a map's origin is.
///
/// Properties, each tested: `key(center(k)) == k` for every key; yaw and yaw + 2π have one key; a
/// yaw half-way between two headings takes the one counter-clockwise of it; a point on a cell's
/// lower or left edge belongs to the cell.
struct PoseGrid {
  static constexpr double kCellSize_m = 0.10;
  static constexpr int kHeadings = 120;
  /// Positions beyond this have no cell: far past any building, and far from integer overflow.
  static constexpr double kMaxCoordinate_m = 1.0e6;

  /// `nullopt` when a coordinate is not finite or beyond `kMaxCoordinate_m`.
  static std::optional<CellIndex> cell(double x_m, double y_m);
  /// floor(yaw / 3° + 0.5) mod 120; `yaw_rad` must be finite.
  static int heading(double yaw_rad);
  static std::optional<GridKey> key(const Pose2& pose);

  /// The centre of the cell at yaw 0: where its view is cast.
  static Pose2 center(const CellIndex& cell);
  static Pose2 center(const GridKey& key);
  static double heading_yaw_rad(int heading);

  /// The column of the view cast at yaw 0 that stands in column `column` of the view turned to
  /// `heading`; `columns` must be a multiple of 120.
  static int source_column(int column, int heading, int columns) {
    const int shifted = (column - heading * (columns / kHeadings)) % columns;
    return shifted < 0 ? shifted + columns : shifted;
  }
};

}  // namespace semview

template <>
struct std::hash<semview::CellIndex> {
  std::size_t operator()(const semview::CellIndex& cell) const noexcept {
    const auto packed = (std::uint64_t{static_cast<std::uint32_t>(cell.ix)} << 32U) |
                        static_cast<std::uint32_t>(cell.iy);
    return static_cast<std::size_t>((packed ^ (packed >> 31U)) * 0x9e3779b97f4a7c15U);
  }
};
