// SPDX-License-Identifier: Apache-2.0
/// An experiment's building in three dimensions, as oriented primitives, and what a camera sees.
///
/// Nothing here shares code, mesh, grid, heights or classes with what renders maps: an experiment
/// whose camera and map are one renderer would prove nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "semview/geometry/image.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/view/column_view.hpp"

namespace semview::paper2017 {

enum class Shape { kBox, kCylinder };

/// A solid with a vertical axis: a box turned about it, or a round one.
struct Primitive {
  Shape shape = Shape::kBox;
  ClassId label = kNoHit;
  std::int32_t object = 0;  ///< parts of one thing share it
  double x_m = 0.0;         ///< centre
  double y_m = 0.0;
  double yaw_rad = 0.0;        ///< of a box's long axis
  double half_length_m = 0.0;  ///< along it; of a cylinder: the radius
  double half_width_m = 0.0;   ///< across it; of a cylinder: unused
  double z_min_m = 0.0;
  double z_max_m = 0.0;
};

struct SceneHit {
  ClassId label = kNoHit;
  std::int32_t object = -1;  ///< < 0: nothing was met
  double range_m = 0.0;
  std::size_t solid = 0;  ///< in `Scene::primitives()`
};

/// The camera: its place, and where its image's middle looks.
struct SceneCamera {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;  ///< > 0 looks down
  double roll_rad = 0.0;   ///< > 0 tilts to the right
  int columns = 268;       ///< of `width_rad`, left to right
  int rows = 76;           ///< of `height_rad`, top to bottom, the horizon in the middle
  double width_rad = 0.0;
  double height_rad = 0.0;
};

/// What each pixel shows; object -1 and label 0 where there is nothing.
struct SceneView {
  LabelImage labels;
  Image<std::int32_t> objects;
  Image<float> ranges_m;
};

/// Solids, sorted into squares of half a metre for quick look-up. Immutable. @threads safe
class Scene {
 public:
  explicit Scene(std::vector<Primitive> primitives);

  const std::vector<Primitive>& primitives() const { return primitives_; }

  /// The nearest surface along a unit direction. A ray that starts in a solid meets its far side.
  SceneHit cast(const Eigen::Vector3d& origin_m, const Eigen::Vector3d& direction) const;

  SceneView render(const SceneCamera& camera) const;

  /// Whether a vertical cylinder would touch something between the two heights.
  bool blocked(double x_m, double y_m, double radius_m, double z_min_m, double z_max_m) const;

 private:
  const std::vector<std::uint32_t>& square(int column, int row) const;

  std::vector<Primitive> primitives_;
  double min_x_m_ = 0.0;
  double min_y_m_ = 0.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::vector<std::uint32_t>> squares_;
};

}  // namespace semview::paper2017
