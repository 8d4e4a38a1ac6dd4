// SPDX-License-Identifier: Apache-2.0
/// One robot's drive through one world with one method and one filter seed.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "methods.hpp"
#include "rows.hpp"
#include "semview/core/clock.hpp"
#include "semview/core/result.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/geometry/affine.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/view/observation.hpp"
#include "semview/view/view_source.hpp"
#include "world.hpp"

namespace semview::paper2017 {

/// What the filter knew at one stop, before it resampled. All errors are distances from the true
/// place, moved with the map where the map is distorted.
struct StopRecord {
  int stop = 0;
  double best_m = 0.0;           ///< of the particle of highest weight
  double estimate_m = 0.0;       ///< of the method's own estimate
  double weighted_mean_m = 0.0;  ///< mean distance of the particles, by weight
  double mean_m = 0.0;           ///< mean distance of the particles
  double min_m = 0.0;            ///< of the nearest particle
  double heading_rad = 0.0;      ///< error of the estimate's heading
  double odometry_m = 0.0;       ///< of odometry alone
  Pose2 map_from_robot;          ///< the method's own estimate
  MapAffine affine;              ///< as estimated; the identity without a distortion in the state
  std::size_t particles = 0;
  double effective_sample_size = 0.0;
  double update_s = 0.0;  ///< how long weighing the particles took; differs from run to run
  ViewOrigins origins;    ///< of the views that were asked for
};

/// A world as one row sees it: observations cut to the row's field of view, poses on its map.
struct RowWorld {
  std::vector<Pose2> truth;     ///< map_from_robot, on the distorted map
  std::vector<Pose2> odometry;  ///< odom_from_robot
  std::vector<Observation> observations;
  std::vector<CellIndex> free_cells;  ///< of the distorted map
  ClassTable map_classes;
};

RowWorld cut_world(const World& world, const Row& row, const PanoramaCamera& profile);

/// The weights of a method for one row's classes.
similarity::WeightMatrix row_weights(const similarity::WeightMatrix& hand,
                                     WeightsKind kind,
                                     ClassSubset classes);

/// The paper's identity matrix: 1 where the hand-made matrix has a column's full match, else 0.
similarity::WeightMatrix identity_of(const similarity::WeightMatrix& hand);

/// @errors those of scoring.
Result<std::vector<StopRecord>> run_trial(const RowWorld& world,
                                          const Method& method,
                                          Start start,
                                          const similarity::WeightMatrix& weights,
                                          ViewSource& views,
                                          ThreadPool& pool,
                                          std::uint64_t seed,
                                          const Clock& clock = steady_clock());

}  // namespace semview::paper2017
