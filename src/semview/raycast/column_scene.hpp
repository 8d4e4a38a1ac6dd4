// SPDX-License-Identifier: Apache-2.0
/// An extruded plan made ready for walks along its pixels.
#pragma once

#include <cstdint>
#include <utility>

#include <Eigen/Core>

#include "semview/geometry/image.hpp"
#include "semview/map/column_map.hpp"

namespace semview::raycast {

/// The stretch of a ray over pixels of one profile, in parameters of the ray.
struct Stretch {
  double begin = 0.0;
  double end = 0.0;
  std::uint8_t profile = 0;
};

/// Which profiles a horizontal ray passes, and where. Immutable.
class ColumnScene {
 public:
  static ColumnScene build(const map::ColumnMap& plan);

  const map::ColumnMap& plan() const { return plan_; }

 private:
  friend class ColumnWalk;
  explicit ColumnScene(map::ColumnMap plan);
  map::ColumnMap plan_;
  /// Of every pixel: all pixels nearer than this many rows and columns have its profile.
  Image<std::uint16_t> reach_;
};

/// The stretches from `from` (frame `map`) along `direction`, which need not be a unit vector:
/// parameter 1 is where it ends. Neighbouring stretches differ in profile, none is empty; the
/// first begins at 0 and the last ends at infinity. What is past the image has profile 0.
///
/// An eye nearer than 0.1 mm to a pixel's edge stands on the side that the ray looks to.
/// @cost of a stretch: O(its pixels / width of the empty space around them).
class ColumnWalk {
 public:
  ColumnWalk(const ColumnScene& scene,
             const Eigen::Vector2d& from,
             const Eigen::Vector2d& direction);

  /// False behind the last one.
  bool next(Stretch& stretch);

 private:
  /// One axis of the plan, in pixels.
  struct Axis {
    double start;
    double slope;
    double inverse;  // of the slope
    int pixels;
    int pixel;  // where the walk is

    static Axis make(double start, double slope, int pixels, double contact_px);
    bool inside() const { return pixel >= 0 && pixel < pixels; }
    double leave(int reach) const;
    void move_to(double parameter, int reach);
    void cross(int reach) { pixel += slope > 0.0 ? reach : -reach; }
    std::pair<double, double> over_image() const;
    void enter(double parameter);
  };

  const ColumnScene& scene_;
  Axis u_;
  Axis v_;
  double parameter_ = 0.0;
  bool ended_ = false;
};

}  // namespace semview::raycast
