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
      for (const auto& [dr, dc] : {std::pair{-1, -1}, {-1, 0}, {-1, 1}, {0, -1}}) relax(r, c, dr, dc);
    }
  }
  for (int r = rows - 1; r >= 0; --r) {
    for (int c = columns - 1; c >= 0; --c) {
      for (const auto& [dr, dc] : {std::pair{1, 1}, {1, 0}, {1, -1}, {0, 1}}) relax(r, c, dr, dc);
    }
  }
  return reach;
}

/// One axis of a walk, in pixels.
struct Axis {
  double start;
  double slope;
  int pixels;

  /// The pixel under the start of the ray.
  int first(double contact_px) const {
    const double nearest = std::round(start);
    if (std::abs(start - nearest) < contact_px) {
      return static_cast<int>(nearest) - (slope < 0.0 ? 1 : 0);
    }
    return static_cast<int>(std::floor(start));
  }
  /// The parameter at which the ray leaves the pixels that are nearer than `reach` to `pixel`.
  double leave(int pixel, int reach) const {
    if (slope == 0.0) return kInfinity;
    const int edge = slope > 0.0 ? pixel + reach : pixel - reach + 1;
    return std::max(0.0, (edge - start) / slope);
  }
  /// Parameters between which the ray is over the image.
  std::pair<double, double> over_image() const {
    if (slope == 0.0) {
      return start >= 0.0 && start < pixels ? std::pair{0.0, kInfinity}
                                            : std::pair{kInfinity, kInfinity};
    }
    const double a = -start / slope;
    const double b = (pixels - start) / slope;
    return {std::min(a, b), std::max(a, b)};
  }
  /// The pixel at a parameter, among those nearer than `reach` to `pixel`.
  int at(double parameter, int pixel, int reach) const {
    return std::clamp(static_cast<int>(std::floor(start + parameter * slope)),
                      pixel - reach + 1,
                      pixel + reach - 1);
  }
};

}  // namespace

ColumnScene::ColumnScene(map::ColumnMap plan)
    : plan_(std::move(plan)), reach_(reach_of(plan_.profile_of_pixel)) {}

void ColumnScene::walk(const Eigen::Vector2d& from,
                       const Eigen::Vector2d& direction,
                       std::vector<Stretch>& stretches) const {
  const double pixels_a_metre = 1.0 / plan_.resolution_m;
  const Eigen::Vector2d start = plan_.plan_from_map(from.x(), from.y()) * pixels_a_metre;
  const double c = std::cos(plan_.origin.yaw_rad) * pixels_a_metre;
  const double s = std::sin(plan_.origin.yaw_rad) * pixels_a_metre;
  const Axis u{start.x(), c * direction.x() + s * direction.y(), plan_.columns()};
  const Axis v{start.y(), c * direction.y() - s * direction.x(), plan_.rows()};
  const double contact_px = kContact_m * pixels_a_metre;

  stretches.clear();
  const auto add = [&stretches](double begin, double end, std::uint8_t profile) {
    if (!(end > begin)) return;
    if (!stretches.empty() && stretches.back().profile == profile) {
      stretches.back().end = end;
    } else {
      stretches.push_back({begin, end, profile});
    }
  };

  int column = u.first(contact_px);
  int up = v.first(contact_px);
  double parameter = 0.0;
  const auto inside = [&] {
    return column >= 0 && column < u.pixels && up >= 0 && up < v.pixels;
  };
  if (!inside()) {
    parameter = std::max({0.0, u.over_image().first, v.over_image().first});
    if (!(parameter < std::min(u.over_image().second, v.over_image().second))) {
      add(0.0, kInfinity, 0);
      return;
    }
    add(0.0, parameter, 0);
    column = std::clamp(static_cast<int>(std::floor(u.start + parameter * u.slope)), 0, u.pixels - 1);
    up = std::clamp(static_cast<int>(std::floor(v.start + parameter * v.slope)), 0, v.pixels - 1);
  }
  while (inside()) {
    const int row = v.pixels - 1 - up;
    const int reach = reach_.at(row, column);
    const double leave_u = u.leave(column, reach);
    const double leave_v = v.leave(up, reach);
    const double leave = std::max(parameter, std::min(leave_u, leave_v));
    add(parameter, leave, plan_.profile_of_pixel.at(row, column));
    if (leave == kInfinity) return;
    if (leave_u <= leave_v) {
      up = v.at(leave, up, reach);
      column += u.slope > 0.0 ? reach : -reach;
    } else {
      column = u.at(leave, column, reach);
      up += v.slope > 0.0 ? reach : -reach;
    }
    parameter = leave;
  }
  add(parameter, kInfinity, 0);
}

}  // namespace semview::raycast
