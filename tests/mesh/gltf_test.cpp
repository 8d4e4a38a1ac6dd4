// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "mesh/furnished_room.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/map/glb_container.hpp"
#include "semview/map/gltf_read.hpp"
#include "semview/map/gltf_write.hpp"

namespace semview::map {
namespace {

using nlohmann::json;
using Triangle = std::tuple<std::string, std::array<std::array<float, 3>, 3>>;

// Triangles by class name and corners, in an order that does not depend on the file's.
std::vector<Triangle> sorted_triangles(const TriangleMesh& mesh,
                                       const std::vector<std::string>& names) {
  std::vector<Triangle> triangles;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    std::array<std::array<float, 3>, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      const Eigen::Vector3f& v = mesh.vertices[mesh.triangles[k][c]];
      corners[c] = {v.x(), v.y(), v.z()};
    }
    triangles.emplace_back(names.at(mesh.labels[k] - std::size_t{1}), corners);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

std::string floats(const std::vector<float>& values) {
  std::string bytes(values.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

// One triangle (0,0,0), (1,0,0), (0,1,0), named as the test wants.
json one_triangle() {
  return json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36}]})");
}

Result<LabelledMesh> read(const json& document,
                          const std::string& binary = floats({0, 0, 0, 1, 0, 0, 0, 1, 0})) {
  return parse_glb(join_glb(document.dump(), binary).value(), "test.glb");
}

TEST(GltfTest, WhatIsWrittenIsReadBackExactly) {
  const SemanticMap map = furnished_room();
  const TriangleMesh mesh = extrude(*map.columns());
  const auto bytes = encode_glb(map, mesh);
  ASSERT_TRUE(bytes) << bytes.error().message;
  const auto back = parse_glb(*bytes, "room.glb");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_TRUE(std::is_sorted(back->class_names.begin(), back->class_names.end()));
  const std::vector<std::string> names(map.classes.names().begin(), map.classes.names().end());
  EXPECT_EQ(sorted_triangles(back->mesh, back->class_names), sorted_triangles(mesh, names));

  const auto relabelled = relabel(*back, map.classes);
  ASSERT_TRUE(relabelled) << relabelled.error().message;
  EXPECT_EQ(sorted_triangles(*relabelled, names), sorted_triangles(mesh, names));
  EXPECT_EQ(*encode_glb(map, mesh), *bytes);
}

TEST(GltfTest, EachClassHasANodeAMeshAndAMaterialOfItsName) {
  const SemanticMap map = furnished_room();
  const std::string bytes = encode_glb(map, extrude(*map.columns())).value();
  const auto document = json::parse(split_glb(bytes, "room.glb").value().json);
  ASSERT_EQ(document["meshes"].size(), document["materials"].size());
  for (std::size_t k = 0; k < document["meshes"].size(); ++k) {
    const json name = document["meshes"][k]["name"];
    EXPECT_EQ(document["materials"][k]["name"], name);
    EXPECT_EQ(document["meshes"][k]["extras"]["semview"]["class"], name);
    EXPECT_EQ(document["nodes"][k + 1]["name"], name);
  }
  const json& wall = document["materials"][2];
  ASSERT_EQ(wall["name"], "wall");
  // sRGB 120 is linear 0.1878 (IEC 61966-2-1).
  EXPECT_NEAR(wall["pbrMetallicRoughness"]["baseColorFactor"][0].get<double>(), 0.1878, 1e-4);
}

TEST(GltfTest, ClassComesFromExtrasThenMaterialThenNodeThenMesh) {
  json document = one_triangle();
  const auto expect_class = [&](const char* name) {
    const auto labelled = read(document);
    ASSERT_TRUE(labelled) << labelled.error().message;
    EXPECT_THAT(labelled->class_names, testing::ElementsAre(name));
  };
  document["meshes"][0]["name"] = "by_mesh";
  expect_class("by_mesh");
  document["nodes"][0]["name"] = "by_node";
  expect_class("by_node");
  document["materials"] = json::parse(R"([{"name": "by_material"}])");
  document["meshes"][0]["primitives"][0]["material"] = 0;
  expect_class("by_material");
  document["nodes"][0]["extras"]["semview"]["class"] = "by_extras";
  expect_class("by_extras");
}

TEST(GltfTest, NodeTransformsApplyAndYUpBecomesZUp) {
  json document = one_triangle();
  document["scenes"][0]["nodes"] = {1};
  document["nodes"][0]["name"] = "wall";
  document["nodes"][0]["translation"] = {0, 0, -2};
  document["nodes"].push_back({{"children", {0}}, {"scale", {2, 2, 2}}});
  const auto labelled = read(document);
  ASSERT_TRUE(labelled) << labelled.error().message;
  // y-up (x, y, z) → z-up (x, -z, y); z = -2 · 2 before.
  EXPECT_EQ(labelled->mesh.vertices[0], Eigen::Vector3f(0, 4, 0));
  EXPECT_EQ(labelled->mesh.vertices[1], Eigen::Vector3f(2, 4, 0));
  EXPECT_EQ(labelled->mesh.vertices[2], Eigen::Vector3f(0, 4, 2));
  EXPECT_EQ(labelled->mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
  document["nodes"][1]["scale"] = {-1, 1, 1};  // a mirror turns front faces round: undone
  EXPECT_EQ(read(document)->mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 2, 1}));
}

TEST(GltfTest, StripsAndFansAreReadPointsAndLinesLeftOut) {
  json document = one_triangle();
  document["nodes"][0]["name"] = "wall";
  document["accessors"][0]["count"] = 5;
  document["bufferViews"][0]["byteLength"] = 60;
  document["buffers"][0]["byteLength"] = 60;
  const std::string binary = floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 2, 0});
  json& primitive = document["meshes"][0]["primitives"][0];
  primitive["mode"] = 5;
  EXPECT_THAT(read(document, binary)->mesh.triangles,
              testing::ElementsAre(std::array<std::uint32_t, 3>{0, 1, 2},
                                   std::array<std::uint32_t, 3>{1, 3, 2},
                                   std::array<std::uint32_t, 3>{2, 3, 4}));
  primitive["mode"] = 6;
  EXPECT_EQ(read(document, binary)->mesh.triangles.size(), 3U);
  EXPECT_EQ(read(document, binary)->mesh.triangles[0], (std::array<std::uint32_t, 3>{1, 2, 0}));
  primitive["mode"] = 0;
  EXPECT_EQ(read(document, binary).error().code, ErrorCode::kInvalidArgument);
}

TEST(GltfTest, MissingClassesAreAllListed) {
  const SemanticMap map = furnished_room();
  const auto labelled =
      parse_glb(encode_glb(map, extrude(*map.columns())).value(), "room.glb").value();
  const auto result = relabel(labelled, ClassTable({"ceiling", "floor", "wall"}));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
  for (const char* name : {"door", "window", "table"}) {
    EXPECT_THAT(result.error().message, testing::HasSubstr(name));
  }
}

TEST(GltfTest, MeshWithoutTrianglesOrWithAForeignLabelIsNotWritten) {
  const SemanticMap map = furnished_room();
  EXPECT_EQ(encode_glb(map, {}).error().code, ErrorCode::kInvalidArgument);
  TriangleMesh mesh = extrude(*map.columns());
  mesh.labels[0] = 200;
  EXPECT_EQ(encode_glb(map, mesh).error().code, ErrorCode::kInvalidArgument);
}

TEST(GltfTest, MissingFileIsNotFound) {
  EXPECT_EQ(read_glb("/nowhere/at/all.glb").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace semview::map
