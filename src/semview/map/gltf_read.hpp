// SPDX-License-Identifier: Apache-2.0
/// Reads labelled meshes from binary glTF 2.0.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/map/triangle_mesh.hpp"

namespace semview::map {

/// A mesh whose labels are places in its own list of names.
struct LabelledMesh {
  TriangleMesh mesh;                     ///< label k is the class `class_names[k - 1]`
  std::vector<std::string> class_names;  ///< sorted, each used by at least one triangle
};

inline constexpr std::size_t kMaxGlbBytes = std::size_t{1} << 30U;

/// Reads the triangles of a file's default scene (else its first, else of all nodes), node
/// transforms applied, turned from glTF's y-up to z-up: x, -z, y.
///
/// The class of a primitive is `extras.semview.class` of its material, mesh or node, else its
/// material's name, else its node's, else its mesh's. Triangles, strips and fans are read; points,
/// lines, textures, animations and skins are left out.
///
/// @errors kNotFound: no such file; kDataLoss: damaged, or an index out of range; kUnimplemented:
/// a glTF 1 file, sparse accessors, compressed or external buffers; kInvalidArgument: no triangle,
/// a triangle without a class, more than `kMaxClasses` classes, coordinates that are not finite or
/// beyond 1000 km; kResourceExhausted: more bytes, vertices or triangles than the limits.
Result<LabelledMesh> read_glb(const std::filesystem::path& path);

/// The same for a file in memory; `name` stands in messages.
Result<LabelledMesh> parse_glb(std::string_view bytes, std::string_view name);

/// The mesh with the ids of `classes` in place of its own.
/// @errors kInvalidArgument: names of the mesh that `classes` does not have, all of them listed.
Result<TriangleMesh> relabel(LabelledMesh labelled, const ClassTable& classes);

}  // namespace semview::map
