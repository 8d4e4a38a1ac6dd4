// SPDX-License-Identifier: Apache-2.0
#include "semview/field/volume_mesh.hpp"

#include <algorithm>
#include <array>
#include <exception>

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/VolumeToMesh.h>

namespace semview::field {
namespace {

constexpr std::size_t kTrianglesAtOnce = 4096;

struct Surface {
  openvdb::FloatGrid::Ptr distance;
  openvdb::BoolGrid::Ptr whole;  ///< cells whose eight corners were all observed
};

bool observed(const SemanticVolume& volume, const VoxelIndex& voxel, float min_weight) {
  return volume.weight(voxel) >= min_weight;
}

Surface surface_of(const SemanticVolume& volume, float min_weight) {
  Surface surface{openvdb::FloatGrid::create(static_cast<float>(volume.shape().truncation_m)),
                  openvdb::BoolGrid::create(false)};
  auto distance = surface.distance->getAccessor();
  auto whole = surface.whole->getAccessor();
  for (const SemanticVolume::BlockIndex& index : volume.block_indices()) {
    const VoxelBlock& block = *volume.block(index);
    for (std::size_t place = 0; place < VoxelBlock::kVoxels; ++place) {
      if (block.weight[place] < min_weight) continue;
      const VoxelIndex v = SemanticVolume::voxel_of(index, place);
      distance.setValueOn({v.x, v.y, v.z}, block.sdf_m[place]);
      bool all = true;
      for (int corner = 1; corner < 8 && all; ++corner) {
        all = observed(
            volume, {v.x + (corner & 1), v.y + (corner >> 1 & 1), v.z + (corner >> 2)}, min_weight);
      }
      if (all) whole.setValueOn({v.x, v.y, v.z}, true);
    }
  }
  return surface;
}

ClassId class_near(const SemanticVolume& volume, const Eigen::Vector3d& point_map) {
  std::array<std::uint32_t, 256> counts{};
  const VoxelIndex middle = volume.voxel_at(point_map);
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const VoxelIndex voxel{middle.x + dx, middle.y + dy, middle.z + dz};
        const VoxelBlock* block = volume.block(SemanticVolume::block_of(voxel));
        if (block == nullptr) continue;
        const std::size_t place = SemanticVolume::place_in_block(voxel);
        for (const ClassCounts& layer : block->counts) counts[layer.label] += layer.count[place];
      }
    }
  }
  const auto most = std::ranges::max_element(counts);
  return *most == 0 ? static_cast<ClassId>(volume.classes().size() + 1)
                    : static_cast<ClassId>(most - counts.begin());
}

void add_triangle(map::TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (a != b && b != c && c != a) mesh.triangles.push_back({a, b, c});
}

map::TriangleMesh triangles_of(const SemanticVolume& volume, const Surface& surface) {
  openvdb::tools::VolumeToMesh mesher(0.0, 0.0);
  mesher.setSurfaceMask(surface.whole);
  mesher(*surface.distance);
  map::TriangleMesh mesh;
  const double voxel_m = volume.shape().voxel_m;
  for (std::size_t i = 0; i < mesher.pointListSize(); ++i) {
    // Index coordinates: whole numbers are the voxels' centres.
    const openvdb::Vec3s& point = mesher.pointList()[i];
    mesh.vertices.emplace_back(
        (Eigen::Vector3d(point.x(), point.y(), point.z()).array() + 0.5).matrix().cast<float>() *
        static_cast<float>(voxel_m));
  }
  for (std::size_t p = 0; p < mesher.polygonPoolListSize(); ++p) {
    const openvdb::tools::PolygonPool& pool = mesher.polygonPoolList()[p];
    for (std::size_t i = 0; i < pool.numQuads(); ++i) {
      const openvdb::Vec4I& quad = pool.quad(i);
      add_triangle(mesh, quad[0], quad[1], quad[2]);
      add_triangle(mesh, quad[0], quad[2], quad[3]);
    }
    for (std::size_t i = 0; i < pool.numTriangles(); ++i) {
      const openvdb::Vec3I& triangle = pool.triangle(i);
      add_triangle(mesh, triangle[0], triangle[1], triangle[2]);
    }
  }
  return mesh;
}

}  // namespace

Result<map::TriangleMesh> mesh_of(const SemanticVolume& volume,
                                  const VolumeMeshConfig& config,
                                  ThreadPool& pool) {
  openvdb::initialize();
  map::TriangleMesh mesh;
  try {
    mesh = triangles_of(volume, surface_of(volume, config.min_weight));
  } catch (const std::exception& error) {
    return fail(ErrorCode::kInternal, fmt::format("meshing the volume: {}", error.what()));
  }
  if (mesh.triangles.empty()) {
    return fail(ErrorCode::kFailedPrecondition,
                fmt::format("the volume has no surface that {:g} frames have seen",
                            static_cast<double>(config.min_weight)));
  }
  mesh.labels.resize(mesh.triangles.size());
  pool.parallel_for(
      mesh.triangles.size(), kTrianglesAtOnce, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          Eigen::Vector3f centre = Eigen::Vector3f::Zero();
          for (const std::uint32_t v : mesh.triangles[i]) centre += mesh.vertices[v] / 3.0F;
          mesh.labels[i] = class_near(volume, centre.cast<double>());
        }
      });
  return mesh;
}

}  // namespace semview::field
