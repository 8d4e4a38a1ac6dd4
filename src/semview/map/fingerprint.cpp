// SPDX-License-Identifier: Apache-2.0
#include "semview/map/fingerprint.hpp"

#include <span>
#include <vector>

namespace semview::map {
namespace {

void add_columns(Hasher& hasher, const ColumnMap& columns) {
  hasher.add_string("columns");
  hasher.add_f64(columns.resolution_m);
  hasher.add_f64(columns.origin.x_m);
  hasher.add_f64(columns.origin.y_m);
  hasher.add_f64(columns.origin.yaw_rad);
  hasher.add_u32(static_cast<std::uint32_t>(columns.rows()));
  hasher.add_u32(static_cast<std::uint32_t>(columns.columns()));
  hasher.add_u32(static_cast<std::uint32_t>(columns.profiles.size()));
  for (const ColumnProfile& profile : columns.profiles) {
    hasher.add_u32(profile.outside ? 1 : 0);
    hasher.add_u32(profile.passable ? 1 : 0);
    hasher.add_u32(profile.ground);
    hasher.add_u32(static_cast<std::uint32_t>(profile.slabs.size()));
    for (const Slab& slab : profile.slabs) {
      hasher.add_f64(slab.z_min_m);
      hasher.add_f64(slab.z_max_m);
      hasher.add_u32(slab.label);
    }
  }
  hasher.add_bytes(std::as_bytes(columns.profile_of_pixel.pixels()));
}

void add_mesh(Hasher& hasher, const TriangleMesh& mesh) {
  hasher.add_string("mesh");
  hasher.add_u64(mesh.vertices.size());
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    // float to double is exact, and add_f64 makes -0 and 0 one.
    for (const float coordinate : {vertex.x(), vertex.y(), vertex.z()}) hasher.add_f64(coordinate);
  }
  hasher.add_u64(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) hasher.add_u32(corner);
  }
  hasher.add_bytes(std::as_bytes(std::span(mesh.labels)));
}

}  // namespace

Fingerprint fingerprint_of(const SemanticMap& map) {
  Hasher hasher;
  hasher.add_string("semview map 1");
  hasher.add_u32(static_cast<std::uint32_t>(map.classes.size()));
  for (const std::string& name : map.classes.names()) hasher.add_string(name);
  hasher.add_f64(map.ground_height_m);
  hasher.add_u32(map.ground_label);
  hasher.add_u32(map.ceiling ? map.ceiling->label : kNoHit);
  hasher.add_f64(map.ceiling ? map.ceiling->height_m : 0.0);
  if (const ColumnMap* columns = map.columns()) add_columns(hasher, *columns);
  if (const MeshGeometry* mesh = map.mesh()) add_mesh(hasher, mesh->mesh);
  return hasher.digest();
}

}  // namespace semview::map
