// SPDX-License-Identifier: Apache-2.0
/// Whether two engines see the same map.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "semview/core/thread_pool.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/column_map.hpp"
#include "semview/raycast/engine.hpp"
#include "semview/view/view_profile.hpp"

namespace semview::raycast {

/// At least this many cells are looked from, where a map has as many.
inline constexpr std::size_t kCheckedCells = 64;
/// Rooms below this many free cells are not counted as such: no robot fits in.
inline constexpr std::size_t kSmallestRoom_cells = 10;

/// Cells with an eye, row by row, from which a check sees all that a plan has:
/// - for every pair of profiles that meet at a pixel's edge, and so for every pair of neighbouring
///   classes, one near (0.5 m) a place where they do, if there is any with an eye;
/// - for every room one in it. A room is a connected part of the free cells that are not in a
///   passable column: what doors part are two rooms;
/// - more, spread evenly, until there are `kCheckedCells`.
std::vector<CellIndex> cells_to_check(const map::ColumnMap& plan, const map::CellGrid& cells);

/// A pixel that two engines see differently.
struct Disagreement {
  CellIndex cell;
  int row = 0;  ///< of the camera that `find_disagreement` takes
  int column = 0;
  ClassId seen = kNoHit;
  ClassId expected = kNoHit;
  float seen_range_m = 0.0F;
  float expected_range_m = 0.0F;
};

/// The first pixel, in the order of `cells`, where labels differ or ranges by more than a
/// centimetre, ties left out: pixels where the reference, too, sees what `engine` sees once its ray
/// is turned by 0.1 mrad, less than a hundredth of a pixel.
///
/// Casts 120 columns and at most 90 rows between the profile's elevations, at yaw 0.
std::optional<Disagreement> find_disagreement(const Engine& engine,
                                              const Engine& reference,
                                              std::span<const CellIndex> cells,
                                              const ViewProfile& profile,
                                              double ground_height_m,
                                              ThreadPool& pool);

}  // namespace semview::raycast
