// SPDX-License-Identifier: Apache-2.0
#include "semview/map/gltf_accessor.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>

namespace semview::map::detail {

Result<Elements> accessor_elements(const tinygltf::Model& model,
                                   int accessor_index,
                                   int type,
                                   std::string_view what) {
  const auto damaged = [](std::string message) {
    return fail(ErrorCode::kDataLoss, std::move(message));
  };
  if (accessor_index < 0 || static_cast<std::size_t>(accessor_index) >= model.accessors.size()) {
    return damaged(fmt::format("{}: there is no accessor {}", what, accessor_index));
  }
  const auto& accessor = model.accessors[static_cast<std::size_t>(accessor_index)];
  if (accessor.sparse.isSparse) {
    return fail(ErrorCode::kUnimplemented,
                fmt::format("{}: sparse accessors are not supported", what));
  }
  const bool known_type =
      type == TINYGLTF_TYPE_VEC3
          ? accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT
          : accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (accessor.type != type || !known_type) {
    return damaged(fmt::format("{}: accessor {} has the wrong type", what, accessor_index));
  }
  if (accessor.bufferView < 0 ||
      static_cast<std::size_t>(accessor.bufferView) >= model.bufferViews.size()) {
    return damaged(fmt::format("{}: accessor {} has no buffer view", what, accessor_index));
  }
  const auto& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size()) {
    return damaged(fmt::format("{}: there is no buffer {}", what, view.buffer));
  }
  const auto& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  const auto size = static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(
                        static_cast<std::uint32_t>(accessor.componentType))) *
                    (type == TINYGLTF_TYPE_VEC3 ? 3U : 1U);
  const std::size_t stride = view.byteStride == 0 ? size : view.byteStride;
  // Each comparison leaves the next one without overflow.
  const bool fits = stride >= size && stride <= 255 && view.byteOffset <= data.size() &&
                    view.byteLength <= data.size() - view.byteOffset &&
                    accessor.byteOffset <= view.byteLength && accessor.count <= data.size() &&
                    (accessor.count == 0 ||
                     stride * (accessor.count - 1) + size <= view.byteLength - accessor.byteOffset);
  if (!fits) {
    return damaged(fmt::format("{}: accessor {} reaches past its buffer", what, accessor_index));
  }
  return Elements{data.data() + view.byteOffset + accessor.byteOffset,
                  accessor.count,
                  stride,
                  accessor.componentType};
}

}  // namespace semview::map::detail
