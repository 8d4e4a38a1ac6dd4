// SPDX-License-Identifier: Apache-2.0
#include "semview/map/gltf_read.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#define TINYGLTF_IMPLEMENTATION
#include "semview/io/text_file.hpp"
#include "semview/map/glb_container.hpp"
#include "semview/map/gltf_document.hpp"
#include "semview/map/gltf_library.hpp"
#include "semview/map/gltf_scene.hpp"

namespace semview::map {
namespace {

Result<LabelledMesh> parse_checked(std::string_view bytes, std::string_view name) {
  SEMVIEW_TRY(const GlbChunks chunks, split_glb(bytes, name));
  SEMVIEW_TRY(const std::string geometry, detail::geometry_only(chunks, name));
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string error;
  std::string warning;
  const bool loaded =
      loader.LoadBinaryFromMemory(&model,
                                  &error,
                                  &warning,
                                  reinterpret_cast<const unsigned char*>(geometry.data()),
                                  static_cast<unsigned int>(geometry.size()));
  if (!loaded) {
    std::replace(error.begin(), error.end(), '\n', ' ');
    return fail(ErrorCode::kDataLoss, fmt::format("{}: damaged glTF: {}", name, error));
  }
  if (!model.asset.version.starts_with("2.")) {
    return fail(ErrorCode::kUnimplemented,
                fmt::format("{}: glTF version {}, expected 2.x", name, model.asset.version));
  }
  return detail::read_scene(model, name);
}

}  // namespace

Result<LabelledMesh> parse_glb(std::string_view bytes, std::string_view name) {
  if (bytes.size() > kMaxGlbBytes) {
    return fail(ErrorCode::kResourceExhausted, fmt::format("{}: more than 1 GiB", name));
  }
  try {
    return parse_checked(bytes, name);
  } catch (const std::exception& error) {
    return fail(ErrorCode::kDataLoss, fmt::format("{}: damaged glTF: {}", name, error.what()));
  }
}

Result<LabelledMesh> read_glb(const std::filesystem::path& path) {
  SEMVIEW_TRY(const std::string bytes, io::read_text_file(path, kMaxGlbBytes));
  return parse_glb(bytes, path.string());
}

Result<TriangleMesh> relabel(LabelledMesh labelled, const ClassTable& classes) {
  std::vector<ClassId> id_of(labelled.class_names.size() + 1, kNoHit);
  std::vector<std::string> missing;
  for (std::size_t k = 0; k < labelled.class_names.size(); ++k) {
    const auto id = classes.id(labelled.class_names[k]);
    if (id) id_of[k + 1] = *id;
    if (!id) missing.push_back(labelled.class_names[k]);
  }
  if (!missing.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("the mesh has classes that the map does not list: {}",
                            fmt::join(missing, ", ")));
  }
  for (ClassId& label : labelled.mesh.labels) label = id_of[label];
  return std::move(labelled.mesh);
}

}  // namespace semview::map
