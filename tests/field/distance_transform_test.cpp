// SPDX-License-Identifier: Apache-2.0
#include "semview/field/distance_transform.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "semview/core/random.hpp"

namespace semview::field {
namespace {

std::vector<std::uint8_t> random_marks(const Box& box, double share, Rng& rng) {
  std::vector<std::uint8_t> marks(box.size());
  for (std::uint8_t& mark : marks) mark = rng.uniform(0.0, 1.0) < share ? 1 : 0;
  return marks;
}

/// Each cell against each.
float squared_distance(
    const std::vector<std::uint8_t>& marks, const Box& box, int x, int y, int z) {
  float best = std::numeric_limits<float>::infinity();
  for (int k = 0; k < box.nz; ++k) {
    for (int j = 0; j < box.ny; ++j) {
      for (int i = 0; i < box.nx; ++i) {
        if (marks[box.index(i, j, k)] == 0) continue;
        const int d2 = (i - x) * (i - x) + (j - y) * (j - y) + (k - z) * (k - z);
        best = std::min(best, static_cast<float>(d2));
      }
    }
  }
  return best;
}

TEST(DistanceTransformTest, DistancesInABoxAreThoseToTheNearestOfAllMarkedCells) {
  Rng rng(5, "marks");
  for (const Box box : {Box{7, 5, 6}, Box{1, 9, 4}, Box{13, 1, 1}, Box{6, 8, 1}}) {
    for (const double share : {0.01, 0.1, 0.6}) {
      const std::vector<std::uint8_t> marks = random_marks(box, share, rng);
      const std::vector<float> found = squared_distances(marks, box);
      for (int z = 0; z < box.nz; ++z) {
        for (int y = 0; y < box.ny; ++y) {
          for (int x = 0; x < box.nx; ++x) {
            ASSERT_EQ(found[box.index(x, y, z)], squared_distance(marks, box, x, y, z))
                << x << ' ' << y << ' ' << z;
          }
        }
      }
    }
  }
}

TEST(DistanceTransformTest, ADistanceInAnImageIsThatOfALayer) {
  Image<std::uint8_t> marks(4, 6);
  marks.at(3, 1) = 7;
  const Image<float> found = squared_distances(marks);
  EXPECT_EQ(found.at(3, 1), 0.0F);
  EXPECT_EQ(found.at(0, 5), 25.0F);
}

TEST(DistanceTransformTest, WhereNothingIsMarkedEverythingIsInfinitelyFar) {
  const Image<float> found = squared_distances(Image<std::uint8_t>(3, 2));
  for (const float d2 : found.pixels()) EXPECT_TRUE(std::isinf(d2));
}

TEST(DistanceTransformTest, AnEmptyGridHasNoDistances) {
  EXPECT_TRUE(squared_distances({}, Box{}).empty());
  EXPECT_TRUE(squared_distances(Image<std::uint8_t>()).empty());
}

}  // namespace
}  // namespace semview::field
