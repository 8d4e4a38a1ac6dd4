// SPDX-License-Identifier: Apache-2.0
#include <omp.h>
#include <open3d/camera/PinholeCameraIntrinsic.h>
#include <open3d/geometry/RGBDImage.h>
#include <open3d/geometry/TriangleMesh.h>
#include <open3d/pipelines/integration/ScalableTSDFVolume.h>

#include "fusion_peer.hpp"

namespace semview::bench {
namespace {

using open3d::pipelines::integration::ScalableTSDFVolume;
using open3d::pipelines::integration::TSDFVolumeColorType;

class Open3dFusion final : public FusionPeer {
 public:
  Open3dFusion(const field::VolumeShape& shape, const field::FusionConfig& config)
      : volume_(shape.voxel_m, shape.truncation_m, TSDFVolumeColorType::NoColor), config_(config) {
    omp_set_num_threads(1);
  }

  void add(const field::DepthFrame& frame) override {
    open3d::geometry::RGBDImage image;
    image.depth_.Prepare(frame.camera.columns, frame.camera.rows, 1, 4);
    image.color_.Prepare(frame.camera.columns, frame.camera.rows, 3, 1);
    for (int r = 0; r < frame.camera.rows; ++r) {
      for (int c = 0; c < frame.camera.columns; ++c) {
        const float depth_m = frame.depth_m.at(r, c);
        const bool usable = depth_m >= config_.min_depth_m && depth_m <= config_.max_depth_m;
        *image.depth_.PointerAt<float>(c, r) = usable ? depth_m : 0.0F;
      }
    }
    // Its pixel centres are whole numbers.
    const open3d::camera::PinholeCameraIntrinsic intrinsic(frame.camera.columns,
                                                           frame.camera.rows,
                                                           frame.camera.fx_px,
                                                           frame.camera.fy_px,
                                                           frame.camera.cx_px - 0.5,
                                                           frame.camera.cy_px - 0.5);
    volume_.Integrate(image, intrinsic, frame.map_from_camera.inverse().matrix());
  }

  map::TriangleMesh mesh() const override {
    const auto found = const_cast<ScalableTSDFVolume&>(volume_).ExtractTriangleMesh();
    map::TriangleMesh mesh;
    for (const Eigen::Vector3d& vertex : found->vertices_) {
      mesh.vertices.push_back(vertex.cast<float>());
    }
    for (const Eigen::Vector3i& t : found->triangles_) {
      mesh.triangles.push_back({static_cast<std::uint32_t>(t.x()),
                                static_cast<std::uint32_t>(t.y()),
                                static_cast<std::uint32_t>(t.z())});
    }
    mesh.labels.assign(mesh.triangles.size(), 1);
    return mesh;
  }

 private:
  ScalableTSDFVolume volume_;
  field::FusionConfig config_;
};

}  // namespace

std::unique_ptr<FusionPeer> open3d_fusion(const field::VolumeShape& shape,
                                          const field::FusionConfig& config) {
  return std::make_unique<Open3dFusion>(shape, config);
}

}  // namespace semview::bench
