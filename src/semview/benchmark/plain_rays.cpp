// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/plain_rays.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "semview/raycast/embree.hpp"

namespace semview::benchmark {

using raycast::Panorama;
using raycast::PanoramaRequest;

struct PlainRays::Embree {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
};

PlainRays::PlainRays(const map::TriangleMesh& mesh)
    : embree_(std::make_unique<Embree>()), labels_(mesh.labels) {
  RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.vertices.size());
  void* triangles = rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size());
  std::memcpy(vertices, mesh.vertices.data(), 12 * mesh.vertices.size());
  std::memcpy(triangles, mesh.triangles.data(), 12 * mesh.triangles.size());
  rtcSetGeometryMask(geometry, ~0U);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(embree_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneBuildQuality(embree_->scene, RTC_BUILD_QUALITY_HIGH);
  rtcCommitScene(embree_->scene);
}

PlainRays::~PlainRays() = default;

std::vector<std::array<float, 3>> directions_of(const PanoramaRequest& request) {
  std::vector<std::array<float, 3>> directions;
  const double yaw = request.map_from_robot.yaw_rad;
  for (int r = 0; r < request.camera.rows; ++r) {
    for (int c = 0; c < request.camera.columns; ++c) {
      const Eigen::Vector3d d = request.camera.direction(r, c);
      directions.push_back({static_cast<float>(d.x() * std::cos(yaw) - d.y() * std::sin(yaw)),
                            static_cast<float>(d.x() * std::sin(yaw) + d.y() * std::cos(yaw)),
                            static_cast<float>(d.z())});
    }
  }
  return directions;
}

Panorama PlainRays::cast(const PanoramaRequest& request,
                         const std::vector<std::array<float, 3>>& directions) const {
  Panorama panorama{LabelImage(request.camera.rows, request.camera.columns),
                    RangeImage(request.camera.rows, request.camera.columns)};
  for (std::size_t i = 0; i < directions.size(); ++i) {
    RTCRayHit query;
    query.ray.org_x = static_cast<float>(request.map_from_robot.x_m);
    query.ray.org_y = static_cast<float>(request.map_from_robot.y_m);
    query.ray.org_z = static_cast<float>(request.eye_z_m);
    query.ray.dir_x = directions[i][0];
    query.ray.dir_y = directions[i][1];
    query.ray.dir_z = directions[i][2];
    query.ray.tnear = 0.0F;
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.time = 0.0F;
    query.ray.mask = ~0U;
    query.ray.flags = 0;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    raycast::intersect_one(embree_->scene, query);
    const bool hit = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    panorama.labels.pixels()[i] = hit ? labels_[query.hit.primID] : kNoHit;
    panorama.ranges_m.pixels()[i] = query.ray.tfar;
  }
  return panorama;
}

}  // namespace semview::benchmark
