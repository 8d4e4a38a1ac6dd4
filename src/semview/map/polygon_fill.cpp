// SPDX-License-Identifier: Apache-2.0
#include "semview/map/polygon_fill.hpp"

#include <algorithm>
#include <cmath>

namespace semview::map::detail {
namespace {

/// In pixels from the plan's lower-left corner, `low` below `high`: an edge that two polygons share
/// is computed alike in both.
struct Edge {
  Eigen::Vector2d low;
  Eigen::Vector2d high;

  double u_at(double v) const {
    return low.x() + (v - low.y()) * (high.x() - low.x()) / (high.y() - low.y());
  }
};

std::vector<Edge> edges_of(const ObjectPolygon& polygon, const ColumnMap& plan) {
  const auto pixels = [&](const Eigen::Vector2d& point) -> Eigen::Vector2d {
    return plan.plan_from_map(point.x(), point.y()) / plan.resolution_m;
  };
  std::vector<Edge> edges;
  for (const Ring& ring : polygon.rings) {
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
      Edge edge{pixels(ring[i]), pixels(ring[i + 1])};
      if (edge.low.y() > edge.high.y()) std::swap(edge.low, edge.high);
      if (edge.low.y() < edge.high.y()) edges.push_back(edge);
    }
  }
  std::ranges::sort(edges, {}, [](const Edge& edge) { return edge.low.y(); });
  return edges;
}

/// The first pixel of a row whose centre is not left of `u`.
int first_column(double u, int columns) {
  return static_cast<int>(std::clamp(std::ceil(u - 0.5), 0.0, static_cast<double>(columns)));
}

}  // namespace

std::vector<PixelRun> pixels_inside(const ObjectPolygon& polygon, const ColumnMap& plan) {
  const std::vector<Edge> edges = edges_of(polygon, plan);
  std::vector<PixelRun> runs;
  if (edges.empty()) return runs;
  std::vector<const Edge*> active;  // those that cross the row's centre line
  std::vector<double> crossings;
  std::size_t next = 0;
  for (int v = first_column(edges.front().low.y(), plan.rows()); v < plan.rows(); ++v) {
    const double center_v = v + 0.5;
    for (; next < edges.size() && edges[next].low.y() <= center_v; ++next) {
      active.push_back(&edges[next]);
    }
    std::erase_if(active, [&](const Edge* edge) { return edge->high.y() <= center_v; });
    if (active.empty() && next == edges.size()) break;
    crossings.clear();
    for (const Edge* edge : active) crossings.push_back(edge->u_at(center_v));
    std::ranges::sort(crossings);
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const int begin = first_column(crossings[i], plan.columns());
      const int end = first_column(crossings[i + 1], plan.columns());
      if (begin < end) runs.push_back({plan.rows() - 1 - v, begin, end});
    }
  }
  return runs;
}

}  // namespace semview::map::detail
