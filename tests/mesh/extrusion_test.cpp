// SPDX-License-Identifier: Apache-2.0
#include "semview/map/extrusion.hpp"

#include <map>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "mesh/reference_column_caster.hpp"
#include "mesh/text_plan.hpp"

namespace semview::map {
namespace {

constexpr ClassId kCeiling = 1;
constexpr ClassId kFloor = 2;
constexpr ClassId kWall = 3;
constexpr ClassId kDoor = 4;
constexpr ClassId kWindow = 5;
constexpr ClassId kTable = 6;
constexpr ClassId kRug = 7;

const std::map<char, ColumnProfile> kProfiles{
    {'.', {.ground = kFloor, .slabs = {}}},
    {'#', {.ground = kFloor, .slabs = {{0.0, 2.5, kWall}}}},
    {'d', {.ground = kFloor, .slabs = {{0.0, 2.0, kDoor}, {2.0, 2.5, kWall}}}},
    {'w', {.ground = kFloor, .slabs = {{0.0, 1.0, kWall}, {1.0, 2.0, kWindow}, {2.0, 2.5, kWall}}}},
    {'l', {.ground = kFloor, .slabs = {{0.0, 1.0, kWall}}}},
    {'t', {.ground = kFloor, .slabs = {{0.75, 1.0, kTable}}}},
    {'r', {.ground = kRug, .slabs = {}}},
};

ColumnMap closed_plan(const std::vector<std::string>& rows, double resolution_m = 1.0) {
  ColumnMap map = plan_from_text(rows, kProfiles, resolution_m);
  map.ceiling = Ceiling{kCeiling, 2.5};
  return map;
}

double area(const TriangleMesh& mesh, std::size_t k) {
  const auto& [a, b, c] = mesh.triangles[k];
  const Eigen::Vector3f ab = mesh.vertices[b] - mesh.vertices[a];
  const Eigen::Vector3f ac = mesh.vertices[c] - mesh.vertices[a];
  return 0.5 * static_cast<double>(ab.cross(ac).norm());
}

std::map<ClassId, double> area_of_class(const TriangleMesh& mesh) {
  std::map<ClassId, double> areas;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) areas[mesh.labels[k]] += area(mesh, k);
  return areas;
}

std::map<ClassId, int> faces_of_class(const TriangleMesh& mesh) {
  std::map<ClassId, int> triangles;
  for (const ClassId label : mesh.labels) ++triangles[label];
  for (auto& [label, count] : triangles) count /= 2;
  return triangles;
}

Hit look(const ColumnMap& map, const Eigen::Vector3d& from, const Eigen::Vector3d& dir) {
  return cast_triangles(extrude(map), from, dir.normalized());
}

TEST(ExtrusionTest, ClosedBoxRoomHasTenRectanglesAndTheAreasOfItsWalls) {
  const TriangleMesh mesh = extrude(closed_plan({"######",  //
                                                 "#....#",
                                                 "#....#",
                                                 "#....#",
                                                 "######"}));
  const auto faces = faces_of_class(mesh);
  EXPECT_EQ(faces.at(kWall), 8);
  EXPECT_EQ(faces.at(kFloor), 1);
  EXPECT_EQ(faces.at(kCeiling), 1);
  const auto areas = area_of_class(mesh);
  EXPECT_DOUBLE_EQ(areas.at(kFloor), 4.0 * 3.0);
  EXPECT_DOUBLE_EQ(areas.at(kCeiling), 4.0 * 3.0);
  EXPECT_DOUBLE_EQ(areas.at(kWall), (2 * (4.0 + 3.0) + 2 * (6.0 + 5.0)) * 2.5);
  EXPECT_EQ(mesh.vertices.size(), 16U);  // eight corners, inside and outside, shared by all faces
}

TEST(ExtrusionTest, FrontFacesAreCounterClockwiseSeenFromFreeSpace) {
  const TriangleMesh mesh = extrude(closed_plan({"####", "#..#", "#.t#", "####"}));
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const Eigen::Vector3d a = mesh.vertices[mesh.triangles[k][0]].cast<double>();
    const Eigen::Vector3d b = mesh.vertices[mesh.triangles[k][1]].cast<double>();
    const Eigen::Vector3d c = mesh.vertices[mesh.triangles[k][2]].cast<double>();
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    const Eigen::Vector3d before = (a + b + c) / 3.0 + 0.01 * normal;
    const ColumnMap map = closed_plan({"####", "#..#", "#.t#", "####"});
    EXPECT_FALSE(solid_at(map, map.at(before.x(), before.y()), before.z())) << "triangle " << k;
    const Eigen::Vector3d behind = before - 0.02 * normal;
    EXPECT_EQ(solid_at(map, map.at(behind.x(), behind.y()), behind.z()), mesh.labels[k]);
  }
}

TEST(ExtrusionTest, RoomBehindALowWallIsSeenOverIt) {
  const ColumnMap map = closed_plan({"#######", "#..l..#", "#######"});
  const Hit over = look(map, {1.5, 1.5, 1.25}, {1.0, 0.0, 0.0});
  EXPECT_EQ(over.label, kWall);
  EXPECT_NEAR(over.range_m, 4.5, 1e-6);
  const Hit on_top = look(map, {1.5, 1.5, 1.5}, {2.0, 0.0, -0.5});
  EXPECT_EQ(on_top.label, kWall);
  EXPECT_NEAR(on_top.range_m, std::hypot(2.0, 0.5), 1e-6);
}

TEST(ExtrusionTest, FloorIsSeenUnderATableTop) {
  const ColumnMap map = closed_plan({"#####", "#.t.#", "#####"});
  EXPECT_EQ(look(map, {1.5, 1.5, 0.5}, {1.0, 0.0, -0.5}).label, kFloor);  // under it, at x = 2.5
  EXPECT_EQ(look(map, {1.5, 1.5, 0.5}, {1.0, 0.0, 0.25}).label, kTable);  // its lower side
  EXPECT_EQ(look(map, {1.5, 1.5, 0.9}, {1.0, 0.0, 0.0}).label, kTable);   // its edge
  EXPECT_EQ(look(map, {1.5, 1.5, 0.5}, {1.0, 0.0, 0.0}).label, kWall);    // the wall behind it
  EXPECT_DOUBLE_EQ(area_of_class(extrude(map)).at(kFloor), 3.0);
  EXPECT_DOUBLE_EQ(area_of_class(extrude(map)).at(kTable),
                   2.0 + 2 * 0.25);  // two sides touch walls
}

TEST(ExtrusionTest, DoorHasTheWallAboveItAndTheWindowAlsoBelow) {
  const ColumnMap map = closed_plan({"##w##", "#...#", "##d##"});
  const Eigen::Vector3d eye(2.5, 1.5, 1.5);
  EXPECT_EQ(look(map, eye, {0.0, -0.5, 0.0}).label, kDoor);
  EXPECT_EQ(look(map, eye, {0.0, -0.5, 0.75}).label, kWall);
  EXPECT_EQ(look(map, eye, {0.0, 0.5, 0.0}).label, kWindow);
  EXPECT_EQ(look(map, eye, {0.0, 0.5, 0.75}).label, kWall);
  EXPECT_EQ(look(map, eye, {0.0, 0.5, -0.75}).label, kWall);
  // Where door and wall touch there is no face between them.
  const auto areas = area_of_class(extrude(map));
  EXPECT_DOUBLE_EQ(areas.at(kDoor), 2 * 2.0);
  EXPECT_DOUBLE_EQ(areas.at(kWindow), 2 * 1.0);
}

TEST(ExtrusionTest, GroundUnderASlabThatStandsOnItIsLeftOut) {
  const ColumnMap map = closed_plan({"#####", "#.l.#", "#####"});
  EXPECT_DOUBLE_EQ(area_of_class(extrude(map)).at(kFloor), 2.0);
  EXPECT_DOUBLE_EQ(area_of_class(extrude(map)).at(kCeiling), 3.0);
}

TEST(ExtrusionTest, PaintReplacesTheGroundUnderItsPixels) {
  const auto areas = area_of_class(extrude(closed_plan({"#####", "#.r.#", "#####"})));
  EXPECT_DOUBLE_EQ(areas.at(kFloor), 2.0);
  EXPECT_DOUBLE_EQ(areas.at(kRug), 1.0);
}

TEST(ExtrusionTest, OutsideHasNeitherGroundNorCeiling) {
  const ColumnMap map = closed_plan({"...   ", "...   "});
  const auto areas = area_of_class(extrude(map));
  EXPECT_DOUBLE_EQ(areas.at(kFloor), 6.0);
  EXPECT_DOUBLE_EQ(areas.at(kCeiling), 6.0);
  EXPECT_EQ(look(map, {1.5, 1.0, 1.0}, {1.0, 0.0, 0.0}).label, kNoHit);
  EXPECT_TRUE(extrude(closed_plan({"  ", "  "})).triangles.empty());
}

TEST(ExtrusionTest, OpenTopHasNoCeilingAndWallsHaveTops) {
  ColumnMap map = closed_plan({"###", "#.#", "###"});
  map.ceiling.reset();
  const auto areas = area_of_class(extrude(map));
  EXPECT_EQ(areas.count(kCeiling), 0U);
  EXPECT_DOUBLE_EQ(areas.at(kWall), (4 + 12) * 2.5 + 8.0);
}

TEST(ExtrusionTest, OriginTurnsAndShiftsThePlan) {
  ColumnMap map = closed_plan({"####", "#..#", "####"}, 0.5);
  map.origin = {10.0, -3.0, kPi / 2.0};
  // The plan's u axis points along the map's y: the room lies at x in [9, 9.5], y in [-2.5, -1.5].
  const Hit along = look(map, {9.25, -2.0, 1.0}, {0.0, 1.0, 0.0});
  EXPECT_EQ(along.label, kWall);
  EXPECT_NEAR(along.range_m, 0.5, 1e-5);
  EXPECT_NEAR(look(map, {9.25, -2.0, 1.0}, {1.0, 0.0, 0.0}).range_m, 0.25, 1e-5);
}

}  // namespace
}  // namespace semview::map
