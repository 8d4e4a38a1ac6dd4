// SPDX-License-Identifier: Apache-2.0
/// ONNX networks written by hand: https://github.com/onnx/onnx/blob/main/onnx/onnx.proto, as bytes.
#pragma once

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace semview::testing {

/// A protobuf message under construction.
class ProtoBytes {
 public:
  ProtoBytes& number(int field, std::uint64_t value) { return tag(field, 0).varint(value); }
  ProtoBytes& bytes(int field, std::string_view value) {
    tag(field, 2).varint(value.size());
    bytes_ += value;
    return *this;
  }
  const std::string& str() const { return bytes_; }

 private:
  ProtoBytes& tag(int field, int wire_type) {
    return varint(static_cast<std::uint64_t>(field) << 3U | static_cast<std::uint64_t>(wire_type));
  }
  ProtoBytes& varint(std::uint64_t value) {
    for (; value > 0x7f; value >>= 7U) bytes_ += static_cast<char>(value | 0x80U);
    bytes_ += static_cast<char>(value);
    return *this;
  }
  std::string bytes_;
};

/// A float tensor.
inline std::string onnx_tensor(const std::string& name,
                               std::initializer_list<int> shape,
                               std::span<const float> values) {
  ProtoBytes tensor;
  for (const int side : shape) tensor.number(1, static_cast<std::uint64_t>(side));
  tensor.number(2, 1);  // FLOAT
  tensor.bytes(8, name);
  std::string raw(values.size_bytes(), '\0');
  std::memcpy(raw.data(), values.data(), raw.size());
  return tensor.bytes(9, raw).str();
}

/// The name and shape of an input or output, of floats.
inline std::string onnx_value(const std::string& name, std::initializer_list<int> shape) {
  ProtoBytes sides;
  for (const int side : shape) {
    sides.bytes(1, ProtoBytes().number(1, static_cast<std::uint64_t>(side)).str());
  }
  const std::string tensor = ProtoBytes().number(1, 1).bytes(2, sides.str()).str();
  return ProtoBytes().bytes(1, name).bytes(2, ProtoBytes().bytes(1, tensor).str()).str();
}

/// A network of one 1 x 1 convolution: `weights` has three numbers a channel (for the input's
/// channels), `bias` one. `operation` other than "Conv" makes a network that OpenCV does not know.
inline std::string onnx_convolution(std::span<const float> weights,
                                    std::span<const float> bias,
                                    int rows,
                                    int columns,
                                    const std::string& operation = "Conv") {
  const int channels = static_cast<int>(bias.size());
  // ONNX takes it from the weights; OpenCV 4.6 wants it said.
  const std::string kernel_shape =
      ProtoBytes().bytes(1, "kernel_shape").number(8, 1).number(8, 1).number(20, 7).str();
  const std::string node = ProtoBytes()
                               .bytes(1, "input")
                               .bytes(1, "weights")
                               .bytes(1, "bias")
                               .bytes(2, "output")
                               .bytes(3, "only")
                               .bytes(4, operation)
                               .bytes(5, kernel_shape)
                               .str();
  const std::string graph = ProtoBytes()
                                .bytes(1, node)
                                .bytes(2, "fixture")
                                .bytes(5, onnx_tensor("weights", {channels, 3, 1, 1}, weights))
                                .bytes(5, onnx_tensor("bias", {channels}, bias))
                                .bytes(11, onnx_value("input", {1, 3, rows, columns}))
                                .bytes(12, onnx_value("output", {1, channels, rows, columns}))
                                .str();
  return ProtoBytes()
      .number(1, 4)
      .bytes(2, "semview tests")
      .bytes(7, graph)
      .bytes(8, ProtoBytes().bytes(1, "").number(2, 9).str())
      .str();
}

}  // namespace semview::testing
