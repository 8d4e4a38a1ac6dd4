// SPDX-License-Identifier: Apache-2.0
#include "semview/map/polygon_fill.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "semview/core/random.hpp"

namespace semview::map::detail {
namespace {

ColumnMap plan(int rows, int columns, double resolution_m, const Pose2& origin = {}) {
  ColumnMap map;
  map.resolution_m = resolution_m;
  map.origin = origin;
  map.profile_of_pixel = Image<std::uint8_t>(rows, columns);
  return map;
}

Image<std::uint8_t> filled(const ObjectPolygon& polygon, const ColumnMap& map) {
  Image<std::uint8_t> image(map.rows(), map.columns());
  for (const PixelRun& run : pixels_inside(polygon, map)) {
    for (int column = run.begin; column < run.end; ++column) ++image.at(run.row, column);
  }
  return image;
}

Ring box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}};
}

/// The slow form: a ray to the right of the centre crosses the rings an odd number of times.
bool is_inside(const ObjectPolygon& polygon, const Eigen::Vector2d& center) {
  bool inside = false;
  for (const Ring& ring : polygon.rings) {
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
      const Eigen::Vector2d a = ring[i];
      const Eigen::Vector2d b = ring[i + 1];
      if ((a.y() <= center.y()) == (b.y() <= center.y())) continue;
      const double x = a.x() + (center.y() - a.y()) * (b.x() - a.x()) / (b.y() - a.y());
      if (x > center.x()) inside = !inside;
    }
  }
  return inside;
}

/// How far a centre is from the nearest edge, so that rounding is no matter of the comparison.
double clearance(const ObjectPolygon& polygon, const Eigen::Vector2d& center) {
  double nearest = INFINITY;
  for (const Ring& ring : polygon.rings) {
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
      const Eigen::Vector2d along = ring[i + 1] - ring[i];
      const double t = std::clamp((center - ring[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (ring[i] + t * along - center).norm());
    }
  }
  return nearest;
}

/// A star of random radii, which never crosses itself, with a smaller one as a hole.
ObjectPolygon random_star(Rng& rng) {
  const Eigen::Vector2d middle(rng.uniform(-1.0, 5.0), rng.uniform(-1.0, 5.0));
  const auto star = [&](double low_m, double high_m) {
    Ring ring;
    const int corners = 3 + static_cast<int>(rng.below(9));
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / corners;
      ring.push_back(middle + rng.uniform(low_m, high_m) *
                                  Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    ring.push_back(ring.front());
    return ring;
  };
  ObjectPolygon polygon{{star(1.2, 3.0)}};
  if (rng.below(2) == 0) polygon.rings.push_back(star(0.1, 0.5));
  return polygon;
}

TEST(PolygonFillTest, CentresAreInsideAsACrossingCountSays) {
  Rng rng(7, "polygons");
  std::size_t inside = 0;
  for (int round = 0; round < 300; ++round) {
    const ObjectPolygon polygon = random_star(rng);
    const ColumnMap map = plan(20 + static_cast<int>(rng.below(30)),
                               20 + static_cast<int>(rng.below(30)),
                               rng.uniform(0.05, 0.2),
                               {rng.uniform(-2.0, 2.0),
                                rng.uniform(-2.0, 2.0),
                                rng.below(2) == 0 ? 0.0 : rng.uniform(-3.1, 3.1)});
    const Image<std::uint8_t> image = filled(polygon, map);
    for (int row = 0; row < map.rows(); ++row) {
      for (int column = 0; column < map.columns(); ++column) {
        const Eigen::Vector2d center = map.pixel_center({row, column});
        if (clearance(polygon, center) < 1e-9) continue;
        ASSERT_EQ(image.at(row, column), is_inside(polygon, center) ? 1 : 0)
            << "round " << round << " row " << row << " column " << column;
        inside += image.at(row, column);
      }
    }
  }
  EXPECT_GT(inside, 10'000U);
}

TEST(PolygonFillTest, CentresOnLeftAndLowerEdgesAreInside) {
  // Centres lie at 0.125, 0.375, 0.625 …: exact, and all edges go through some.
  const ColumnMap map = plan(4, 4, 0.25);
  const Image<std::uint8_t> image = filled({{box(0.125, 0.125, 0.625, 0.375)}}, map);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      EXPECT_EQ(image.at(row, column), row == 3 && column < 2 ? 1 : 0) << row << " " << column;
    }
  }
}

TEST(PolygonFillTest, NeighboursThatShareAnEdgeShareNoPixelAndLeaveNoneOut) {
  Rng rng(8, "polygons");
  const ColumnMap map = plan(40, 40, 0.1);
  for (int round = 0; round < 200; ++round) {
    // Of eighths, so that the common edge often goes through centres.
    const auto eighths = [&] { return static_cast<double>(rng.below(33)) / 8.0; };
    const Eigen::Vector2d a(eighths(), 0.0);
    const Eigen::Vector2d b(eighths(), 4.0);
    const Image<std::uint8_t> left = filled({{{{0, 0}, a, b, {0, 4}, {0, 0}}}}, map);
    const Image<std::uint8_t> right = filled({{{a, {4, 0}, {4, 4}, b, a}}}, map);
    for (std::size_t i = 0; i < left.pixels().size(); ++i) {
      ASSERT_EQ(left.pixels()[i] + right.pixels()[i], 1) << "round " << round;
    }
  }
}

TEST(PolygonFillTest, WhatReachesFarBeyondThePlanFillsIt) {
  const ColumnMap map = plan(3, 5, 0.1, {10.0, -4.0, 0.7});
  const Image<std::uint8_t> image = filled({{box(-1e6, -1e6, 1e6, 1e6)}}, map);
  for (const std::uint8_t pixel : image.pixels()) EXPECT_EQ(pixel, 1);
  EXPECT_TRUE(pixels_inside({{box(1e3, 1e3, 1e6, 1e6)}}, map).empty());
}

TEST(PolygonFillTest, CrossingsAreFoundAndTouchesAreNot) {
  const Ring bow{{0, 0}, {1, 1}, {1, 0}, {0, 1}, {0, 0}};
  const auto crossing = crossing_in({{bow}});
  ASSERT_TRUE(crossing);
  EXPECT_NEAR(crossing->x(), 0.5, 1e-12);
  EXPECT_NEAR(crossing->y(), 0.5, 1e-12);
  EXPECT_TRUE(crossing_in({{box(0, 0, 2, 2), box(1, 1, 3, 3)}})) << "a hole across the outline";
  EXPECT_FALSE(crossing_in({{box(0, 0, 2, 2), box(0.5, 0.5, 1.5, 1.5)}}));
  EXPECT_FALSE(crossing_in({{box(0, 0, 2, 2), {{1, 1}, {2, 1.3}, {1, 1.6}, {1, 1}}}}))
      << "a hole may touch the outline";
  EXPECT_FALSE(crossing_in({{{{0, 0}, {0, 0}, {1, 0}, {1, 1}, {0, 0}}}})) << "a point twice";
}

}  // namespace
}  // namespace semview::map::detail
