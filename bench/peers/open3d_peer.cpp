// SPDX-License-Identifier: Apache-2.0
// Open3D's RaycastingScene as a peer.
//
// Debian builds Embree with ray masks and Open3D 0.16 casts with a mask of 0: every ray of it
// misses. So this library has an rtcIntersect1M of its own, which Open3D finds before Embree's: it
// sets the masks and goes on to Embree.
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include <dlfcn.h>
#include <embree3/rtcore.h>
#include <open3d/core/Tensor.h>
#include <open3d/t/geometry/RaycastingScene.h>

#include "semview/benchmark/peer.hpp"

extern "C" __attribute__((visibility("default"))) void rtcIntersect1M(
    RTCScene scene, RTCIntersectContext* context, RTCRayHit* rays, unsigned count, size_t stride) {
  using Function = void (*)(RTCScene, RTCIntersectContext*, RTCRayHit*, unsigned, size_t);
  static const auto next = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "rtcIntersect1M"));
  for (unsigned i = 0; i < count; ++i) {
    auto* ray = reinterpret_cast<RTCRayHit*>(reinterpret_cast<char*>(rays) + i * stride);
    ray->ray.mask = ~0U;
  }
  next(scene, context, rays, count, stride);
}

namespace semview::benchmark {
namespace {

using open3d::core::Dtype;
using open3d::core::Tensor;

class Open3dCaster final : public CasterPeer {
 public:
  explicit Open3dCaster(const map::TriangleMesh& mesh) : scene_(1) {
    const auto vertices = static_cast<std::int64_t>(mesh.vertices.size());
    const auto triangles = static_cast<std::int64_t>(mesh.triangles.size());
    scene_.AddTriangles(Tensor(reinterpret_cast<const float*>(mesh.vertices.data()),
                               {vertices, 3},
                               open3d::core::Float32),
                        Tensor(reinterpret_cast<const std::uint32_t*>(mesh.triangles.data()),
                               {triangles, 3},
                               open3d::core::UInt32));
  }

  std::size_t add_rays(std::span<const float> rays) override {
    const auto count = static_cast<std::int64_t>(rays.size() / 6);
    rays_.emplace_back(rays.data(), open3d::core::SizeVector{count, 6}, open3d::core::Float32);
    hits_.emplace_back();
    return rays_.size() - 1;
  }

  void cast(std::size_t image) override { hits_[image] = scene_.CastRays(rays_[image], 1); }

  std::vector<std::uint32_t> triangles(std::size_t image) const override {
    return hits_[image].at("primitive_ids").ToFlatVector<std::uint32_t>();
  }
  std::vector<float> parameters(std::size_t image) const override {
    return hits_[image].at("t_hit").ToFlatVector<float>();
  }

 private:
  open3d::t::geometry::RaycastingScene scene_;
  std::vector<Tensor> rays_;
  std::vector<std::unordered_map<std::string, Tensor>> hits_;
};

}  // namespace
}  // namespace semview::benchmark

extern "C" __attribute__((visibility("default"))) semview::benchmark::CasterPeer*
semview_make_caster_peer(const semview::map::TriangleMesh& mesh) {
  return new semview::benchmark::Open3dCaster(mesh);
}
