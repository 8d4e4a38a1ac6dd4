// SPDX-License-Identifier: Apache-2.0
/// Embree 3 or 4 under one set of names. For sources of this module, and for the plain loop that it
/// is measured against: no other header names Embree.
///
/// Only calls that both versions have are used: single rays and packets of 16. The stream calls
/// (1M, NM, Np) are gone in Embree 4.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace semview::raycast {

/// Casts one ray; `ray_hit.ray.mask` and the hit ids must be set.
inline void intersect_one(RTCScene scene, RTCRayHit& ray_hit) {
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene, &ray_hit);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray_hit);
#endif
}

/// Casts the lanes with `valid[lane] == -1` of a packet whose rays are neighbours.
inline void intersect_coherent(RTCScene scene, const int* valid, RTCRayHit16& ray_hits) {
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &ray_hits, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &context, &ray_hits);
#endif
}

}  // namespace semview::raycast
