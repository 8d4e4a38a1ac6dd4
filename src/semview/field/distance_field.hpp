// SPDX-License-Identifier: Apache-2.0
/// How far every place of a map is from the nearest thing of each class.
#pragma once

#include <memory>
#include <span>

#include "semview/core/result.hpp"
#include "semview/field/semantic_volume.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/map/column_map.hpp"
#include "semview/semantics/class_table.hpp"

namespace semview::field {

/// Square cells in a plane of constant height; cell (column, row) covers
/// [column·cell, (column+1)·cell) × [row·cell, (row+1)·cell) of frame `grid`, row 0 the lowest.
struct LayerGrid {
  Pose2 map_from_grid;
  double cell_m = 0.05;
  int columns = 0;
  int rows = 0;

  std::size_t cells() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
};

/// The distances of one map, squared as the likelihood wants them, sampled layer by layer at the
/// centres of cells.
///
/// Requirements: never negative, and infinite where nothing of the class is within reach (see the
/// maker) or in the map at all. The grid goes beyond the map on all sides, by the maker's margin:
/// distances are those there, and whoever asks for a place farther out takes the nearest cell.
/// @threads Const members from several threads at once.
class DistanceField {
 public:
  virtual ~DistanceField() = default;

  virtual const ClassTable& classes() const = 0;
  virtual const LayerGrid& grid() const = 0;
  /// The ground that robots stand on, in frame `map`.
  virtual double ground_height_m() const = 0;

  /// Squared distance, m², of each cell's centre at height `z_m` of frame `map` to the nearest
  /// thing of a class: S of equation (5); for `kNoHit` infinite. `squared_m2` has grid().cells()
  /// entries, row by row.
  virtual void sample_class(ClassId label, double z_m, std::span<float> squared_m2) const = 0;

  /// Squared distance to the nearest surface: sdf² of equation (4).
  virtual void sample_surface(double z_m, std::span<float> squared_m2) const = 0;
};

/// Distances of a drawn map; no mapping run is needed. Walls, ground and ceiling are classes like
/// all others. A thing is a slab (also its inside is at distance 0), or the ground or the ceiling
/// where no slab touches it.
///
/// Exact between pixel centres, without truncation: a distance in space is the least
/// hypot(d2, dz) over the things of one class between the same two heights, so that it takes one
/// field in the plane for each (class, z interval).
/// @param cell_m  Cells of the layers, not below the map's resolution; a cell takes the distance of
///                the pixel under its centre.
/// @errors kInvalidArgument: a cell below the resolution; kResourceExhausted: fields of more than
/// `kMaxFieldCells` in all.
Result<std::unique_ptr<DistanceField>> distances_of_plan(const map::ColumnMap& plan,
                                                         ClassTable classes,
                                                         double cell_m = 0.05,
                                                         double margin_m = 2.0);

/// How far from a surface `sample_surface` of a fused volume still tells the distance to it.
enum class SurfaceReach {
  /// The stored signed distances alone: no more than the truncation distance, which is also what a
  /// voxel has that was never observed.
  kTruncation,
  /// Where these end, the distance between voxel centres to the nearest voxel that the surface
  /// passes. With the printed σ_sdf of 2 m the stored ones, cut at some 0.2 m, tell next to
  /// nothing: at most 0.005 nats a pixel.
  kEverywhere,
};

/// Distances of a fused volume, sampled in its own voxels.
///
/// Distances to a class are those between voxel centres, exact up to `reach_m` and infinite beyond;
/// kept in a box round each class's voxels. Heights above and below the volume's blocks have the
/// distances of the nearest layer.
/// @param reach_m  At most 255 voxels.
/// @errors kInvalidArgument: an empty volume, too far a reach; kResourceExhausted: fields of more
/// than `kMaxFieldCells` in all.
Result<std::unique_ptr<DistanceField>> distances_of_volume(const SemanticVolume& volume,
                                                           double ground_height_m,
                                                           SurfaceReach surface,
                                                           double reach_m = 6.0,
                                                           double margin_m = 1.0);

/// Some 2 GB.
inline constexpr std::size_t kMaxFieldCells = 500'000'000;

}  // namespace semview::field
