// SPDX-License-Identifier: Apache-2.0
/// What stands behind `Scene`. Internal to this module.
#pragma once

#include <cstddef>
#include <cstdint>
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
  RTCScene scene = nullptr;         ///< one geometry: a hit's primID is the triangle's index
  std::vector<ClassId> labels;      ///< one a triangle
  const float* vertices = nullptr;  ///< Embree's own copy: x, y, z each
  const std::uint32_t* triangles = nullptr;  ///< Embree's own copy: three vertices each
  SceneBounds bounds;

  Eigen::Vector3d corner(std::uint32_t triangle, int which) const {
    const float* vertex =
        vertices +
        3 * std::size_t{triangles[3 * std::size_t{triangle} + static_cast<unsigned>(which)]};
    return {vertex[0], vertex[1], vertex[2]};
  }
};

}  // namespace semview::raycast
