// SPDX-License-Identifier: Apache-2.0
#include "semview/map/gltf_document.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace semview::map::detail {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxJsonBytes = std::size_t{64} << 20U;
constexpr int kMaxJsonDepth = 64;

/// An extension that only changes how surfaces look.
bool is_about_looks(const std::string& extension) {
  return extension.starts_with("KHR_materials_") || extension.starts_with("KHR_texture_") ||
         extension.starts_with("KHR_lights_");
}

Status check_required_extensions(const json& document, std::string_view name) {
  const auto required = document.find("extensionsRequired");
  if (required == document.end() || !required->is_array()) return {};
  for (const json& extension : *required) {
    if (extension.is_string() && is_about_looks(extension.get<std::string>())) continue;
    return fail(
        ErrorCode::kUnimplemented,
        fmt::format(
            "{}: needs the glTF extension {}, which is not supported", name, extension.dump()));
  }
  return {};
}

Status check_buffers(const json& document, std::string_view name) {
  const auto buffers = document.find("buffers");
  if (buffers == document.end() || !buffers->is_array()) return {};
  for (const json& buffer : *buffers) {
    if (buffers->size() != 1 || (buffer.is_object() && buffer.contains("uri"))) {
      return fail(ErrorCode::kUnimplemented,
                  fmt::format("{}: buffers outside its own binary chunk are not supported", name));
    }
  }
  return {};
}

/// tinygltf drops a primitive that it cannot parse without a word.
bool primitives_are_sound(const json& document) {
  const json none = json::array();
  for (const json& mesh : document.value("meshes", none)) {
    if (!mesh.is_object()) return false;
    for (const json& primitive : mesh.value("primitives", none)) {
      const auto attributes =
          primitive.is_object() ? primitive.find("attributes") : primitive.end();
      if (!primitive.is_object() || attributes == primitive.end() || !attributes->is_object()) {
        return false;
      }
      for (const json& accessor : *attributes) {
        if (!accessor.is_number_integer()) return false;
      }
    }
  }
  return true;
}

}  // namespace

Result<std::string> geometry_only(const GlbChunks& chunks, std::string_view name) {
  if (chunks.json.size() > kMaxJsonBytes) {
    return fail(ErrorCode::kResourceExhausted, fmt::format("{}: more than 64 MiB of JSON", name));
  }
  bool too_deep = false;
  const auto limit_depth = [&](int depth, json::parse_event_t, json&) {
    too_deep = too_deep || depth > kMaxJsonDepth;
    return !too_deep;
  };
  json document = json::parse(chunks.json, limit_depth, false);
  if (too_deep || !document.is_object()) {
    return fail(ErrorCode::kDataLoss,
                fmt::format("{}: its JSON is {}",
                            name,
                            too_deep ? "nested too deeply" : "damaged or not an object"));
  }
  SEMVIEW_TRY_STATUS(check_required_extensions(document, name));
  SEMVIEW_TRY_STATUS(check_buffers(document, name));
  if (!primitives_are_sound(document)) {
    return fail(ErrorCode::kDataLoss, fmt::format("{}: a mesh has a damaged primitive", name));
  }
  for (const char* key : {"animations",
                          "cameras",
                          "images",
                          "samplers",
                          "skins",
                          "textures",
                          "extensions",
                          "extensionsRequired",
                          "extensionsUsed"}) {
    document.erase(key);
  }
  json materials = json::array();
  for (const json& material : document.value("materials", json::array())) {
    json kept = json::object();
    for (const char* key : {"name", "extras"}) {
      if (material.is_object() && material.contains(key)) kept[key] = material[key];
    }
    materials.push_back(std::move(kept));
  }
  document["materials"] = std::move(materials);
  return join_glb(document.dump(-1, ' ', false, json::error_handler_t::replace), chunks.binary);
}

}  // namespace semview::map::detail
