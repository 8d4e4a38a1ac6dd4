// SPDX-License-Identifier: Apache-2.0
// Damaged files: an error or a sound mesh, never a crash (run under AddressSanitizer too).
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "mesh/furnished_room.hpp"
#include "semview/core/random.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/map/glb_container.hpp"
#include "semview/map/gltf_read.hpp"
#include "semview/map/gltf_write.hpp"

namespace semview::map {
namespace {

using nlohmann::json;

const std::string& sound_file() {
  static const std::string bytes = [] {
    const SemanticMap map = furnished_room();
    return encode_glb(map, extrude(*map.columns())).value();
  }();
  return bytes;
}

void expect_error_or_sound_mesh(const std::string& bytes) {
  const auto labelled = parse_glb(bytes, "damaged.glb");
  if (!labelled) {
    EXPECT_FALSE(labelled.error().message.empty());
    return;
  }
  const TriangleMesh& mesh = labelled->mesh;
  ASSERT_EQ(mesh.labels.size(), mesh.triangles.size());
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    ASSERT_GE(mesh.labels[k], 1);
    ASSERT_LE(mesh.labels[k], labelled->class_names.size());
    for (const std::uint32_t v : mesh.triangles[k]) ASSERT_LT(v, mesh.vertices.size());
  }
  for (const Eigen::Vector3f& v : mesh.vertices) ASSERT_TRUE(v.allFinite());
}

TEST(GltfDamageTest, EveryTruncationIsDataLoss) {
  const std::string& bytes = sound_file();
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 40) {
    const auto labelled = parse_glb(bytes.substr(0, size), "cut.glb");
    ASSERT_FALSE(labelled) << size;
    EXPECT_EQ(labelled.error().code, ErrorCode::kDataLoss) << size;
  }
}

TEST(GltfDamageTest, ChangedBytesNeverCrash) {
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    Rng rng(seed, "bytes");
    std::string bytes = sound_file();
    // Two in three within the header and the JSON, where the damage can be read as anything.
    const std::size_t reach = seed % 3 == 0 ? bytes.size() : bytes.size() / 3;
    for (std::uint64_t k = 0; k <= seed % 5; ++k) {
      bytes[rng.below(reach)] = static_cast<char>(rng.below(256));
    }
    expect_error_or_sound_mesh(bytes);
  }
}

// Every value in the JSON, one by one, replaced by every kind of nonsense.
void collect_pointers(const json& value,
                      const json::json_pointer& at,
                      std::vector<json::json_pointer>& out) {
  if (!at.empty()) out.push_back(at);
  if (value.is_object()) {
    for (const auto& item : value.items()) collect_pointers(item.value(), at / item.key(), out);
  } else if (value.is_array()) {
    for (std::size_t k = 0; k < value.size(); ++k) collect_pointers(value[k], at / k, out);
  }
}

TEST(GltfDamageTest, NonsenseInAnyPlaceOfTheJsonNeverCrashes) {
  const GlbChunks chunks = split_glb(sound_file(), "sound.glb").value();
  const json sound = json::parse(chunks.json);
  std::vector<json::json_pointer> places;
  collect_pointers(sound, json::json_pointer(), places);
  ASSERT_GT(places.size(), 200U);
  const std::vector<json> nonsense{nullptr,
                                   true,
                                   -1,
                                   0,
                                   7,
                                   255,
                                   65536,
                                   4294967296LL,
                                   -9223372036854775807LL,
                                   18446744073709551615ULL,
                                   1e300,
                                   0.5,
                                   "",
                                   "x",
                                   json::array(),
                                   json::object(),
                                   json::array({1, 2, 3}),
                                   json::parse("[[[[{}]]]]")};
  for (const auto& place : places) {
    for (const json& value : nonsense) {
      json damaged = sound;
      damaged[place] = value;
      expect_error_or_sound_mesh(join_glb(damaged.dump(), chunks.binary).value());
      if (testing::Test::HasFailure()) FAIL() << place.to_string() << " = " << value.dump();
    }
  }
}

TEST(GltfDamageTest, ForeignVersionsExtensionsAndBuffersAreNamed) {
  const GlbChunks chunks = split_glb(sound_file(), "sound.glb").value();
  const json sound = json::parse(chunks.json);
  const auto code_with = [&](const char* pointer, const json& value) {
    json changed = sound;
    changed[json::json_pointer(pointer)] = value;
    return parse_glb(join_glb(changed.dump(), chunks.binary).value(), "x.glb").error().code;
  };
  EXPECT_EQ(code_with("/asset/version", "1.0"), ErrorCode::kUnimplemented);
  EXPECT_EQ(code_with("/extensionsRequired", {"KHR_draco_mesh_compression"}),
            ErrorCode::kUnimplemented);
  EXPECT_EQ(code_with("/buffers/0/uri", "other.bin"), ErrorCode::kUnimplemented);
  EXPECT_EQ(code_with("/buffers/0/uri", "/etc/passwd"), ErrorCode::kUnimplemented);
  EXPECT_EQ(code_with("/nodes/0/children", {0}), ErrorCode::kDataLoss);  // a node below itself
  std::string old = sound_file();
  old[4] = 1;
  EXPECT_EQ(parse_glb(old, "x.glb").error().code, ErrorCode::kUnimplemented);
}

TEST(GltfDamageTest, DeepNestingIsRefusedBeforeAnythingRecurses) {
  const std::string deep = R"({"asset":{"version":"2.0","extras":)" + std::string(200000, '[') +
                           std::string(200000, ']') + "}}";
  EXPECT_EQ(parse_glb(join_glb(deep, "").value(), "x.glb").error().code, ErrorCode::kDataLoss);
}

}  // namespace
}  // namespace semview::map
