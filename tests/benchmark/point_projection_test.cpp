// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/point_projection.hpp"

#include <gtest/gtest.h>

#include "reference/point_projection.hpp"
#include "semview/benchmark/office_plan.hpp"
#include "semview/benchmark/subject.hpp"

namespace semview::benchmark {
namespace {

TEST(PointProjectionTest, SeesWhatTheLiteralProjectionOfTheSamePointsSees) {
  const auto office = draw_office({15.0, 12.5, 0.1, 11, 1});
  ASSERT_TRUE(office);
  const PointCloud points = point_cloud(*office->columns());
  std::vector<reference::LabelledPoint> literal;
  for (std::size_t i = 0; i < points.size(); ++i) {
    literal.push_back({{points.x_m[i], points.y_m[i], points.z_m[i]}, points.labels[i]});
  }
  const PanoramaCamera camera = camera_of(240);
  const LabelImage expected = reference::project_points(literal, {7.53, 6.21, 0.0}, 1.2, camera);
  const LabelImage seen = project_points(points, {7.53F, 6.21F, 1.2F}, camera);
  int different = 0;
  for (std::size_t i = 0; i < seen.pixels().size(); ++i) {
    if (seen.pixels()[i] != expected.pixels()[i]) ++different;
  }
  // Single precision: a point on the edge of a pixel may fall to either side.
  EXPECT_LE(different, 5);
}

TEST(PointProjectionTest, APlanHasAPointAVoxel) {
  map::ColumnMap plan;
  plan.resolution_m = 0.1;
  plan.profiles = {{true, false, kNoHit, {}}, {false, false, 1, {{0.0, 0.5, 2}}}};
  plan.profile_of_pixel = Image<std::uint8_t>(1, 2, 0);
  plan.profile_of_pixel.at(0, 1) = 1;
  plan.ceiling = map::Ceiling{3, 2.5};
  // Ground, five of the slab, ceiling; nothing of the pixel that is outside.
  EXPECT_EQ(point_cloud(plan).labels, (std::vector<ClassId>{1, 2, 2, 2, 2, 2, 3}));
}

}  // namespace
}  // namespace semview::benchmark
