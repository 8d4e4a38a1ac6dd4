// SPDX-License-Identifier: Apache-2.0
/// Writes labelled meshes as binary glTF 2.0.
#pragma once

#include <filesystem>
#include <string>

#include "semview/core/result.hpp"
#include "semview/map/triangle_mesh.hpp"

namespace semview::map {

struct SemanticMap;

/// A mesh as the bytes of a GLB file: y-up by a rotation of the root node; below it one node, mesh
/// and material a class that has triangles, in the order of the map's classes, each with the
/// class's name and `extras.semview.class`, the material in the class's colour. The same mesh gives
/// the same bytes.
/// @errors kInvalidArgument: no triangles, a label that is not a class of `map`, or more than 4
/// GiB.
Result<std::string> encode_glb(const SemanticMap& map, const TriangleMesh& mesh);

/// Writes `encode_glb` to `path`.
/// @errors as `encode_glb`; kUnavailable: the file cannot be written.
Status write_glb(const SemanticMap& map,
                 const TriangleMesh& mesh,
                 const std::filesystem::path& path);

}  // namespace semview::map
