// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "semview/map/map_object.hpp"

namespace semview::map::detail {
namespace {

/// Decimal numbers that were meant to touch cross by less, once rounded to doubles.
constexpr double kTouch_m = 1e-6;

struct Edge {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  double min_x() const { return std::min(from.x(), to.x()); }
  double max_x() const { return std::max(from.x(), to.x()); }
};

/// How far `point` lies to the left of the line of `edge`, metres.
double left_of(const Edge& edge, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = edge.to - edge.from;
  const Eigen::Vector2d off = point - edge.from;
  return (along.x() * off.y() - along.y() * off.x()) / along.norm();
}

bool on_both_sides(const Edge& edge, const Edge& other) {
  const double a_m = left_of(edge, other.from);
  const double b_m = left_of(edge, other.to);
  return (a_m > kTouch_m && b_m < -kTouch_m) || (a_m < -kTouch_m && b_m > kTouch_m);
}

}  // namespace

std::optional<Eigen::Vector2d> crossing_in(const ObjectPolygon& polygon) {
  std::vector<Edge> edges;
  for (const Ring& ring : polygon.rings) {
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
      if (ring[i] != ring[i + 1]) edges.push_back({ring[i], ring[i + 1]});
    }
  }
  std::ranges::sort(edges, {}, &Edge::min_x);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size() && edges[j].min_x() <= edges[i].max_x(); ++j) {
      if (!on_both_sides(edges[i], edges[j]) || !on_both_sides(edges[j], edges[i])) continue;
      const double a_m = left_of(edges[i], edges[j].from);
      const double b_m = left_of(edges[i], edges[j].to);
      return edges[j].from + (edges[j].to - edges[j].from) * (a_m / (a_m - b_m));
    }
  }
  return std::nullopt;
}

}  // namespace semview::map::detail
