// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/scene.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "semview/map/extrusion.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/scene_impl.hpp"

namespace semview::raycast {
namespace {

// Embree's own threads are not instrumented: under ThreadSanitizer a device has none.
#if defined(__SANITIZE_THREAD__)
constexpr const char* kDeviceSettings = "threads=1";
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
constexpr const char* kDeviceSettings = "threads=1";
#else
constexpr const char* kDeviceSettings = nullptr;
#endif
#else
constexpr const char* kDeviceSettings = nullptr;
#endif

Status check(const map::TriangleMesh& mesh) {
  const std::size_t count = mesh.triangles.size();
  if (count == 0)
    return fail(ErrorCode::kInvalidArgument,
                "there is no surface to see: a plan of nothing but outside, or no triangles");
  if (count > kMaxTriangles) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("mesh has {} triangles, more than {}", count, kMaxTriangles));
  }
  if (mesh.labels.size() != count) {
    return fail(
        ErrorCode::kInvalidArgument,
        fmt::format(
            "mesh has {} labels for {} triangles, not one each", mesh.labels.size(), count));
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      if (vertex < mesh.vertices.size()) continue;
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("mesh triangle {} has vertex {}, but there are only {}",
                              i,
                              vertex,
                              mesh.vertices.size()));
    }
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (mesh.vertices[i].allFinite()) continue;
    return fail(ErrorCode::kInvalidArgument, fmt::format("mesh vertex {} is not finite", i));
  }
  return {};
}

Status embree_error(RTCDevice device, const char* step) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return {};
  return fail(ErrorCode::kInternal,
              fmt::format("embree: {} failed with error {}", step, static_cast<int>(error)));
}

/// Copies the mesh into buffers that Embree owns as long as the scene lives.
Status fill_geometry(Scene::Impl& impl, RTCGeometry geometry, const map::TriangleMesh& mesh) {
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry,
                                                               RTC_BUFFER_TYPE_VERTEX,
                                                               0,
                                                               RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float),
                                                               mesh.vertices.size()));
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(geometry,
                                                                      RTC_BUFFER_TYPE_INDEX,
                                                                      0,
                                                                      RTC_FORMAT_UINT3,
                                                                      3 * sizeof(std::uint32_t),
                                                                      mesh.triangles.size()));
  if (vertices == nullptr || indices == nullptr) {
    SEMVIEW_TRY_STATUS(embree_error(impl.device, "allocating the mesh"));
    return fail(ErrorCode::kInternal, "embree: allocating the mesh failed");
  }
  impl.vertices = vertices;
  impl.triangles = indices;
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    *vertices++ = vertex.x();
    *vertices++ = vertex.y();
    *vertices++ = vertex.z();
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t index : triangle) *indices++ = index;
  }
  return {};
}

SceneBounds bounds_of(const map::TriangleMesh& mesh) {
  const Eigen::Vector3f& first = mesh.vertices[mesh.triangles[0][0]];
  SceneBounds bounds{first, first};
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t index : triangle) {
      bounds.min = bounds.min.cwiseMin(mesh.vertices[index]);
      bounds.max = bounds.max.cwiseMax(mesh.vertices[index]);
    }
  }
  return bounds;
}

}  // namespace

Result<Scene> Scene::build(const map::TriangleMesh& mesh, const SceneConfig& config) {
  SEMVIEW_TRY_STATUS(check(mesh));
  auto impl = std::make_unique<Impl>();
  impl->labels = mesh.labels;
  impl->bounds = bounds_of(mesh);
  impl->device = rtcNewDevice(kDeviceSettings);
  if (impl->device == nullptr) return fail(ErrorCode::kInternal, "embree: no device");
  impl->scene = rtcNewScene(impl->device);
  rtcSetSceneFlags(impl->scene, config.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(impl->scene, RTC_BUILD_QUALITY_HIGH);

  RTCGeometry geometry = rtcNewGeometry(impl->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Debian builds Embree with ray masks: a geometry or ray that leaves its mask unset is never hit.
  rtcSetGeometryMask(geometry, ~0U);
  const Status filled = fill_geometry(*impl, geometry, mesh);
  if (filled) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(impl->scene, geometry);
  }
  rtcReleaseGeometry(geometry);
  SEMVIEW_TRY_STATUS(filled);
  rtcCommitScene(impl->scene);
  SEMVIEW_TRY_STATUS(embree_error(impl->device, "building the scene"));
  return Scene(std::move(impl));
}

Result<Scene> Scene::build(const map::SemanticMap& map) {
  const map::MeshGeometry* geometry = map.mesh();
  return build(geometry != nullptr ? geometry->mesh : map::extrude(*map.columns()));
}

Scene::Scene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

const SceneBounds& Scene::bounds() const { return impl_->bounds; }
std::size_t Scene::triangles() const { return impl_->labels.size(); }

}  // namespace semview::raycast
