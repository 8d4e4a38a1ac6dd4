// SPDX-License-Identifier: Apache-2.0
#include "semview/map/gltf_write.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "semview/core/version.hpp"
#include "semview/io/text_file.hpp"
#include "semview/map/glb_container.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::map {
namespace {

using nlohmann::json;

constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;

/// The part of a mesh that has one class, with vertices of its own.
struct ClassPart {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::uint32_t> indices;
};

std::vector<ClassPart> split_by_class(const TriangleMesh& mesh, int classes) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::vector<std::size_t>> triangles_of(static_cast<std::size_t>(classes) + 1);
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    triangles_of[mesh.labels[k]].push_back(k);
  }
  std::vector<ClassPart> parts(triangles_of.size());
  std::vector<std::uint32_t> place_of(mesh.vertices.size(), kUnused);
  for (std::size_t label = 1; label < parts.size(); ++label) {
    ClassPart& part = parts[label];
    for (const std::size_t k : triangles_of[label]) {
      for (const std::uint32_t v : mesh.triangles[k]) {
        if (place_of[v] == kUnused) {
          place_of[v] = static_cast<std::uint32_t>(part.vertices.size());
          part.vertices.push_back(mesh.vertices[v]);
        }
        part.indices.push_back(place_of[v]);
      }
    }
    for (const std::size_t k : triangles_of[label]) {
      for (const std::uint32_t v : mesh.triangles[k]) place_of[v] = kUnused;
    }
  }
  return parts;
}

template <typename T>
json append_view(std::string& binary, const std::vector<T>& values, int target) {
  static_assert(sizeof(T) % 4 == 0);  // keeps every view on a whole word
  const std::size_t offset = binary.size();
  const std::size_t bytes = values.size() * sizeof(T);
  binary.resize(offset + bytes);
  std::memcpy(binary.data() + offset, values.data(), bytes);
  return {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}, {"target", target}};
}

json vector3(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

// glTF's colours are linear; a class's colour is sRGB (IEC 61966-2-1).
double linear(unsigned char srgb) {
  const double c = srgb / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

json material(const std::string& name, const Rgb& color) {
  // To 1e-4, so that a library's last bit of pow() does not change the file.
  const auto factor = [](unsigned char c) { return std::round(linear(c) * 1e4) / 1e4; };
  return {{"name", name},
          {"extras", {{"semview", {{"class", name}}}}},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {factor(color.r), factor(color.g), factor(color.b), 1.0}},
            {"metallicFactor", 0.0},
            {"roughnessFactor", 1.0}}}};
}

Status check(const SemanticMap& map, const TriangleMesh& mesh) {
  if (mesh.triangles.empty() || mesh.labels.size() != mesh.triangles.size()) {
    return fail(ErrorCode::kInvalidArgument,
                "a mesh without triangles, or without a class for each");
  }
  for (const ClassId label : mesh.labels) {
    if (label == kNoHit || label > map.classes.size()) {
      return fail(
          ErrorCode::kInvalidArgument,
          fmt::format(
              "a triangle of class {}, but the map has {} classes", label, map.classes.size()));
    }
  }
  return {};
}

}  // namespace

Result<std::string> encode_glb(const SemanticMap& map, const TriangleMesh& mesh) {
  SEMVIEW_TRY_STATUS(check(map, mesh));
  std::string binary;
  json document{{"asset", {{"version", "2.0"}, {"generator", fmt::format("semview {}", kVersion)}}},
                {"scene", 0},
                {"scenes", {{{"nodes", {0}}}}}};
  // A quarter turn about x takes the z-up frame `map` to glTF's y-up.
  constexpr double kHalf = std::numbers::sqrt2 / 2.0;
  document["nodes"] = {{{"rotation", {-kHalf, 0.0, 0.0, kHalf}}, {"children", json::array()}}};
  if (!map.id.empty()) document["nodes"][0]["name"] = map.id;
  const std::vector<ClassPart> parts = split_by_class(mesh, map.classes.size());
  for (std::size_t label = 1; label < parts.size(); ++label) {
    const ClassPart& part = parts[label];
    if (part.indices.empty()) continue;
    const std::string& name = map.classes.names()[label - 1];
    Eigen::Vector3f low = part.vertices.front();
    Eigen::Vector3f high = low;
    for (const Eigen::Vector3f& v : part.vertices) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
    const std::size_t number = document["meshes"].size();
    document["bufferViews"].push_back(append_view(binary, part.vertices, kArrayBuffer));
    document["bufferViews"].push_back(append_view(binary, part.indices, kElementArrayBuffer));
    document["accessors"].push_back({{"bufferView", 2 * number},
                                     {"componentType", kFloat},
                                     {"count", part.vertices.size()},
                                     {"type", "VEC3"},
                                     {"min", vector3(low)},
                                     {"max", vector3(high)}});
    document["accessors"].push_back({{"bufferView", 2 * number + 1},
                                     {"componentType", kUnsignedInt},
                                     {"count", part.indices.size()},
                                     {"type", "SCALAR"}});
    document["materials"].push_back(
        material(name,
                 map.class_details.size() >= label
                     ? map.class_details[label - 1].color.value_or(Rgb{200, 200, 200})
                     : Rgb{200, 200, 200}));
    const json primitive{{"attributes", {{"POSITION", 2 * number}}},
                         {"indices", 2 * number + 1},
                         {"material", number}};
    const json extras{{"semview", {{"class", name}}}};
    document["meshes"].push_back(
        {{"name", name}, {"extras", extras}, {"primitives", json::array({primitive})}});
    document["nodes"].push_back({{"name", name}, {"mesh", number}, {"extras", extras}});
    document["nodes"][0]["children"].push_back(number + 1);
  }
  document["buffers"] = {{{"byteLength", binary.size()}}};
  return join_glb(document.dump(-1, ' ', false, json::error_handler_t::replace), binary);
}

Status write_glb(const SemanticMap& map,
                 const TriangleMesh& mesh,
                 const std::filesystem::path& path) {
  SEMVIEW_TRY(const std::string bytes, encode_glb(map, mesh));
  return io::write_text_file(path, bytes);
}

}  // namespace semview::map
