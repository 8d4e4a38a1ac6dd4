// SPDX-License-Identifier: Apache-2.0
/// Casts single rays. Internal to this module.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "semview/raycast/scene_impl.hpp"

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace semview::raycast {

/// A direction as Embree takes it: unit, or a unit direction through a `MapAffine`, so that a ray's
/// parameter is the true range.
struct RayDirection {
  float x, y, z;
};

/// The nearest surface along a ray.
struct RayHit {
  ClassId label = kNoHit;
  float parameter = std::numeric_limits<float>::infinity();
  bool back_face = false;      ///< met from the side that is not free space
  std::uint32_t triangle = 0;  ///< where something was hit
};

/// Sets flush-to-zero and denormals-are-zero, as Embree asks, for the life of this object.
class DenormalsOff {
 public:
#if defined(__SSE__)
  DenormalsOff() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | kFlushToZero | kDenormalsAreZero); }
  ~DenormalsOff() { _mm_setcsr(saved_); }

 private:
  static constexpr unsigned kFlushToZero = 0x8000;
  static constexpr unsigned kDenormalsAreZero = 0x0040;
  unsigned saved_;
#else
  DenormalsOff() = default;
#endif
 public:
  DenormalsOff(const DenormalsOff&) = delete;
  DenormalsOff& operator=(const DenormalsOff&) = delete;
};

/// Rays from one eye.
///
/// Cell centres often lie exactly on faces of a plan drawn at 5 or 10 cm, where rounding decides
/// on which side the eye is. So every ray starts `kTouch` behind the eye: a face that looks at the
/// eye is then met even when the eye is on it or a hair behind it. A back face within `kTouch` of
/// the eye on either side is what such an eye stands on and looks away from: it is passed through.
class RayCaster {
 public:
  static constexpr float kTouch = 1e-4F;

  RayCaster(const Scene& scene, float eye_x, float eye_y, float eye_z)
      : impl_(scene.impl()), eye_x_(eye_x), eye_y_(eye_y), eye_z_(eye_z) {}

  RayHit cast(const RayDirection& direction) const {
    RTCRayHit ray_hit = ray(direction, 0.0F);
    intersect_one(impl_.scene, ray_hit);
    if (ray_hit.ray.tfar <= 2.0F * kTouch && facing_away(direction, ray_hit)) {
      ray_hit = ray(direction, 2.0F * kTouch);
      intersect_one(impl_.scene, ray_hit);
    }
    if (ray_hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    const unsigned triangle = ray_hit.hit.primID;
    return {impl_.labels[triangle],
            std::max(0.0F, ray_hit.ray.tfar - kTouch),
            facing_away(direction, ray_hit),
            triangle};
  }

  /// Where the ray of a direction starts: kTouch behind the eye.
  float start_x(float direction_x) const { return eye_x_ - kTouch * direction_x; }
  float start_y(float direction_y) const { return eye_y_ - kTouch * direction_y; }
  float start_z(float direction_z) const { return eye_z_ - kTouch * direction_z; }
  const Scene::Impl& scene() const { return impl_; }

 private:
  RTCRayHit ray(const RayDirection& d, float start) const {
    RTCRayHit ray_hit{};
    ray_hit.ray.org_x = start_x(d.x);
    ray_hit.ray.org_y = start_y(d.y);
    ray_hit.ray.org_z = start_z(d.z);
    ray_hit.ray.dir_x = d.x;
    ray_hit.ray.dir_y = d.y;
    ray_hit.ray.dir_z = d.z;
    ray_hit.ray.tnear = start;
    ray_hit.ray.tfar = std::numeric_limits<float>::infinity();
    ray_hit.ray.mask = ~0U;
    ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray_hit.hit.primID = RTC_INVALID_GEOMETRY_ID;
    ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return ray_hit;
  }

  static bool facing_away(const RayDirection& d, const RTCRayHit& ray_hit) {
    return d.x * ray_hit.hit.Ng_x + d.y * ray_hit.hit.Ng_y + d.z * ray_hit.hit.Ng_z > 0.0F;
  }

  const Scene::Impl& impl_;
  float eye_x_, eye_y_, eye_z_;
};

}  // namespace semview::raycast
