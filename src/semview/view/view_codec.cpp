// SPDX-License-Identifier: Apache-2.0
#include "semview/view/view_codec.hpp"

#include <fmt/format.h>

#include "semview/view/view_codec_1.hpp"
#include "semview/view/view_codec_2.hpp"

namespace semview {

std::vector<std::byte> encode_view(const ColumnView& view) { return detail::encode_view_2(view); }

std::optional<ViewShape> claimed_shape(std::uint8_t codec, std::span<const std::byte> bytes) {
  return codec == kViewCodec ? detail::claimed_shape_2(bytes) : std::nullopt;
}

Result<ColumnView> decode_view(std::uint8_t codec,
                               std::span<const std::byte> bytes,
                               const ViewShape& shape) {
  if (codec == kViewCodec) return detail::decode_view_2(bytes, shape);
  if (codec == 1 && !shape.ranges) return detail::decode_view_1(bytes, shape.columns, shape.rows);
  return fail(ErrorCode::kUnimplemented,
              fmt::format("view: codec {}, this program knows 1 and {}", codec, kViewCodec));
}

}  // namespace semview
