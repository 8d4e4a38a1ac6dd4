// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/column_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace semview::raycast {
namespace {

constexpr double kContact_m = 1e-4;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Chebyshev distance to the nearest pixel of another profile, two passes of a chamfer mask (exact
/// for this metric). The image's border counts as another profile.
Image<std::uint16_t> reach_of(const Image<std::uint8_t>& profiles) {
  const int rows = profiles.rows();
  const int columns = profiles.columns();
  Image<std::uint16_t> reach(rows, columns, std::numeric_limits<std::uint16_t>::max());
  const auto relax = [&](int r, int c, int dr, int dc) {
    const int other_row = r + dr;
    const int other_column = c + dc;
    const bool inside =
        other_row >= 0 && other_row < rows && other_column >= 0 && other_column < columns;
    const bool same = inside && profiles.at(other_row, other_column) == profiles.at(r, c);
    const int distance = same ? reach.at(other_row, other_column) + 1 : 1;
    if (distance < reach.at(r, c)) reach.at(r, c) = static_cast<std::uint16_t>(distance);
  };
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      for (const auto& [dr, dc] : {std::pair{-1, -1}, {-1, 0}, {-1, 1}, {0, -1}})
        relax(r, c, dr, dc);
    }
  }
  for (int r = rows - 1; r >= 0; --r) {
    for (int c = columns - 1; c >= 0; --c) {
      for (const auto& [dr, dc] : {std::pair{1, 1}, {1, 0}, {1, -1}, {0, 1}}) relax(r, c, dr, dc);
    }
  }
  return reach;
}

}  // namespace

ColumnScene::ColumnScene(map::ColumnMap plan)
    : plan_(std::move(plan)), reach_(reach_of(plan_.profile_of_pixel)) {}

ColumnScene ColumnScene::build(const map::ColumnMap& plan) { return ColumnScene(plan); }

ColumnWalk::Axis ColumnWalk::Axis::make(double start, double slope, int pixels, double contact_px) {
  Axis axis{start, slope, 1.0 / slope, pixels, static_cast<int>(std::floor(start))};
  const double edge = std::round(start);
  if (std::abs(start - edge) < contact_px) axis.pixel = static_cast<int>(edge) - (slope < 0.0);
  return axis;
}

/// The parameter at which the ray leaves the pixels that are nearer than `reach`.
double ColumnWalk::Axis::leave(int reach) const {
  if (slope == 0.0) return kInfinity;
  const int edge = slope > 0.0 ? pixel + reach : pixel - reach + 1;
  return (edge - start) * inverse;
}

/// To where the ray is at a parameter, among the pixels nearer than `reach`.
void ColumnWalk::Axis::move_to(double parameter, int reach) {
  if (reach == 1) return;
  const int there = static_cast<int>(std::floor(start + parameter * slope));
  pixel = std::clamp(there, pixel - reach + 1, pixel + reach - 1);
}

/// Parameters between which the ray is over the image.
std::pair<double, double> ColumnWalk::Axis::over_image() const {
  if (slope == 0.0) return {start >= 0.0 && start < pixels ? 0.0 : kInfinity, kInfinity};
  const double a = -start * inverse;
  const double b = (pixels - start) * inverse;
  return {std::min(a, b), std::max(a, b)};
}

void ColumnWalk::Axis::enter(double parameter) {
  pixel = std::clamp(static_cast<int>(std::floor(start + parameter * slope)), 0, pixels - 1);
}

ColumnWalk::ColumnWalk(const ColumnScene& scene,
                       const Eigen::Vector2d& from,
                       const Eigen::Vector2d& direction)
    : scene_(scene) {
  const map::ColumnMap& plan = scene.plan();
  const double pixels_a_metre = 1.0 / plan.resolution_m;
  const Eigen::Vector2d start = plan.plan_from_map(from.x(), from.y()) * pixels_a_metre;
  const double c = std::cos(plan.origin.yaw_rad) * pixels_a_metre;
  const double s = std::sin(plan.origin.yaw_rad) * pixels_a_metre;
  const double contact_px = kContact_m * pixels_a_metre;
  u_ = Axis::make(start.x(), c * direction.x() + s * direction.y(), plan.columns(), contact_px);
  v_ = Axis::make(start.y(), c * direction.y() - s * direction.x(), plan.rows(), contact_px);
}

bool ColumnWalk::next(Stretch& stretch) {
  if (ended_) return false;
  stretch = {parameter_, kInfinity, 0};
  if (!(u_.inside() && v_.inside())) {
    const auto [u_in, u_out] = u_.over_image();
    const auto [v_in, v_out] = v_.over_image();
    const double in = std::max({parameter_, u_in, v_in});
    if (parameter_ == 0.0 && in < std::min(u_out, v_out)) {
      u_.enter(in);
      v_.enter(in);
      stretch.end = parameter_ = in;
      if (in > 0.0) return true;
    } else {
      ended_ = true;
      return true;
    }
  }
  const auto& profiles = scene_.plan_.profile_of_pixel;
  bool started = false;
  while (u_.inside() && v_.inside()) {
    const int row = v_.pixels - 1 - v_.pixel;
    const std::uint8_t profile = profiles.at(row, u_.pixel);
    if (started && profile != stretch.profile) {
      stretch.end = parameter_;
      return true;
    }
    const int reach = scene_.reach_.at(row, u_.pixel);
    const double leave_u = u_.leave(reach);
    const double leave_v = v_.leave(reach);
    const double leave = std::min(leave_u, leave_v);
    if (leave > parameter_) {
      // Only here: pixels that the ray merely touches do not count.
      if (!started) stretch = {parameter_, kInfinity, profile};
      started = true;
      parameter_ = leave;
      if (leave == kInfinity) {
        ended_ = true;
        return true;
      }
    }
    if (leave_u <= leave_v) {
      v_.move_to(leave, reach);
      u_.cross(reach);
    } else {
      u_.move_to(leave, reach);
      v_.cross(reach);
    }
  }
  if (started && stretch.profile != 0) {
    stretch.end = parameter_;
    return true;
  }
  ended_ = true;
  return true;
}

}  // namespace semview::raycast
