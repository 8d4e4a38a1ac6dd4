// SPDX-License-Identifier: Apache-2.0
/// Casts the rays of an image: the loops that all renderers share. Internal to this module.
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
  static constexpr int kLanes = 16;

  RayCaster(const Scene& scene, float eye_x, float eye_y, float eye_z)
      : impl_(scene.impl()), eye_x_(eye_x), eye_y_(eye_y), eye_z_(eye_z) {}

  RayHit cast(const RayDirection& direction) const {
    RTCRayHit ray_hit = ray(direction, 0.0F);
    intersect_one(impl_.scene, ray_hit);
    return settle(direction,
                  ray_hit.hit.geomID != RTC_INVALID_GEOMETRY_ID,
                  ray_hit.hit.primID,
                  ray_hit.ray.tfar,
                  facing_away(direction, ray_hit.hit.Ng_x, ray_hit.hit.Ng_y, ray_hit.hit.Ng_z));
  }

  /// Casts `directions[lane]` for the lanes with `valid[lane] == -1`; others must hold any finite
  /// direction. The same hits as `cast`.
  void cast_packet(const int* valid, const RayDirection* directions, RayHit* hits) const {
    alignas(64) RTCRayHit16 packet;
    for (int lane = 0; lane < kLanes; ++lane) {
      const RayDirection& d = directions[lane];
      packet.ray.org_x[lane] = eye_x_ - kTouch * d.x;
      packet.ray.org_y[lane] = eye_y_ - kTouch * d.y;
      packet.ray.org_z[lane] = eye_z_ - kTouch * d.z;
      packet.ray.dir_x[lane] = d.x;
      packet.ray.dir_y[lane] = d.y;
      packet.ray.dir_z[lane] = d.z;
      packet.ray.tnear[lane] = 0.0F;
      packet.ray.tfar[lane] = std::numeric_limits<float>::infinity();
      packet.ray.time[lane] = 0.0F;
      packet.ray.mask[lane] = ~0U;
      packet.ray.id[lane] = 0;
      packet.ray.flags[lane] = 0;
      packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.primID[lane] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
    intersect_coherent(impl_.scene, valid, packet);
    for (int lane = 0; lane < kLanes; ++lane) {
      if (valid[lane] == 0) continue;
      hits[lane] = settle(directions[lane],
                          packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID,
                          packet.hit.primID[lane],
                          packet.ray.tfar[lane],
                          facing_away(directions[lane],
                                      packet.hit.Ng_x[lane],
                                      packet.hit.Ng_y[lane],
                                      packet.hit.Ng_z[lane]));
    }
  }

 private:
  RTCRayHit ray(const RayDirection& d, float start) const {
    RTCRayHit ray_hit{};
    ray_hit.ray.org_x = eye_x_ - kTouch * d.x;
    ray_hit.ray.org_y = eye_y_ - kTouch * d.y;
    ray_hit.ray.org_z = eye_z_ - kTouch * d.z;
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

  static bool facing_away(const RayDirection& d, float normal_x, float normal_y, float normal_z) {
    return d.x * normal_x + d.y * normal_y + d.z * normal_z > 0.0F;
  }

  /// The hit of a ray as an image records it; casts once more when it met a touched back face.
  RayHit settle(const RayDirection& direction,
                bool hit,
                unsigned triangle,
                float start_to_hit,
                bool back_face) const {
    if (!hit) return {};
    if (start_to_hit <= 2.0F * kTouch && back_face) {
      RTCRayHit again = ray(direction, 2.0F * kTouch);
      intersect_one(impl_.scene, again);
      if (again.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
      triangle = again.hit.primID;
      start_to_hit = again.ray.tfar;
      back_face = facing_away(direction, again.hit.Ng_x, again.hit.Ng_y, again.hit.Ng_z);
    }
    return {impl_.labels[triangle], std::max(0.0F, start_to_hit - kTouch), back_face, triangle};
  }

  const Scene::Impl& impl_;
  float eye_x_, eye_y_, eye_z_;
};

/// Calls `store(row, column, hit)` for every pixel of a rows × columns image, in packets of 4 × 4
/// pixels. `direction(row, column)` gives a pixel's ray.
template <typename Direction, typename Store>
void cast_tiles(const RayCaster& caster,
                int rows,
                int columns,
                const Direction& direction,
                const Store& store) {
  constexpr int kTile = 4;
  const DenormalsOff denormals_off;
  alignas(64) int valid[RayCaster::kLanes];
  RayDirection directions[RayCaster::kLanes];
  RayHit hits[RayCaster::kLanes];
  for (int top = 0; top < rows; top += kTile) {
    for (int left = 0; left < columns; left += kTile) {
      for (int lane = 0; lane < RayCaster::kLanes; ++lane) {
        const int row = top + lane / kTile;
        const int column = left + lane % kTile;
        const bool inside = row < rows && column < columns;
        valid[lane] = inside ? -1 : 0;
        directions[lane] = inside ? direction(row, column) : directions[0];
      }
      caster.cast_packet(valid, directions, hits);
      for (int lane = 0; lane < RayCaster::kLanes; ++lane) {
        if (valid[lane] != 0) store(top + lane / kTile, left + lane % kTile, hits[lane]);
      }
    }
  }
}

/// The same, ray by ray.
template <typename Direction, typename Store>
void cast_singly(const RayCaster& caster,
                 int rows,
                 int columns,
                 const Direction& direction,
                 const Store& store) {
  const DenormalsOff denormals_off;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      store(row, column, caster.cast(direction(row, column)));
    }
  }
}

}  // namespace semview::raycast
