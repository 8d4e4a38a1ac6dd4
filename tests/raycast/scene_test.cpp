// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/scene.hpp"

#include <limits>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "raycast/small_worlds.hpp"

namespace semview::raycast {
namespace {

TEST(SceneTest, KnowsItsBoundsAndSize) {
  const auto scene = Scene::build(box_room({-1, -2, 0}, {3, 4, 2.5F}));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->triangles(), 12U);
  EXPECT_EQ(scene->bounds().min, Eigen::Vector3f(-1, -2, 0));
  EXPECT_EQ(scene->bounds().max, Eigen::Vector3f(3, 4, 2.5F));
}

TEST(SceneTest, BoundsIgnoreVerticesThatNoTriangleUses) {
  map::TriangleMesh mesh = box_room({0, 0, 0}, {1, 1, 1});
  mesh.vertices.emplace_back(100, 100, 100);
  EXPECT_EQ(Scene::build(mesh)->bounds().max, Eigen::Vector3f(1, 1, 1));
}

TEST(SceneTest, RefusesMeshesThatItCannotCast) {
  const map::TriangleMesh room = box_room({0, 0, 0}, {1, 1, 1});
  const auto message = [](const map::TriangleMesh& mesh) {
    const auto scene = Scene::build(mesh);
    return scene ? "no error" : scene.error().message;
  };
  EXPECT_THAT(message({}), testing::HasSubstr("no triangles"));
  map::TriangleMesh unlabelled = room;
  unlabelled.labels.pop_back();
  EXPECT_THAT(message(unlabelled), testing::HasSubstr("11 labels for 12 triangles"));
  map::TriangleMesh dangling = room;
  dangling.triangles[3][1] = 24;
  EXPECT_THAT(message(dangling), testing::HasSubstr("triangle 3 has vertex 24"));
  map::TriangleMesh endless = room;
  endless.vertices[5].y() = std::numeric_limits<float>::infinity();
  EXPECT_THAT(message(endless), testing::HasSubstr("vertex 5 is not finite"));
}

TEST(SceneTest, MovesWithoutLosingItsGeometry) {
  auto first = Scene::build(box_room({0, 0, 0}, {1, 1, 1}));
  ASSERT_TRUE(first);
  Scene second = std::move(*first);
  EXPECT_EQ(second.triangles(), 12U);
}

}  // namespace
}  // namespace semview::raycast
