// SPDX-License-Identifier: Apache-2.0
/// What stands behind `Scene`. Internal to this module.
#pragma once

#include <vector>

#include "semview/raycast/embree.hpp"
#include "semview/raycast/scene.hpp"

namespace semview::raycast {

struct Scene::Impl {
  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  RTCDevice device = nullptr;
  RTCScene scene = nullptr;     ///< one geometry: a hit's primID is the triangle's index
  std::vector<ClassId> labels;  ///< one a triangle
  SceneBounds bounds;
};

}  // namespace semview::raycast
