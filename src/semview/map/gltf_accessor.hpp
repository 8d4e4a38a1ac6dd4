// SPDX-License-Identifier: Apache-2.0
/// The numbers of a glTF accessor. Inside the module only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "semview/core/result.hpp"
#include "semview/map/gltf_library.hpp"

namespace semview::map::detail {

/// Elements of an accessor, checked to lie within their buffer.
struct Elements {
  const unsigned char* first = nullptr;
  std::size_t count = 0;
  std::size_t stride = 0;
  int component_type = 0;

  template <typename T>
  T get(std::size_t element, std::size_t component = 0) const {
    T value{};
    std::memcpy(&value, first + element * stride + component * sizeof(T), sizeof(T));
    return value;
  }
  std::uint32_t index(std::size_t element) const {
    switch (component_type) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return get<std::uint8_t>(element);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return get<std::uint16_t>(element);
      default:
        return get<std::uint32_t>(element);
    }
  }
};

/// @param type  TINYGLTF_TYPE_VEC3 of floats, or TINYGLTF_TYPE_SCALAR of whole numbers.
/// @errors kDataLoss: not such an accessor, or it reaches past its buffer; kUnimplemented: sparse.
/// The messages begin with `what`.
Result<Elements> accessor_elements(const tinygltf::Model& model,
                                   int accessor_index,
                                   int type,
                                   std::string_view what);

}  // namespace semview::map::detail
