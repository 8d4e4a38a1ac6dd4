// SPDX-License-Identifier: Apache-2.0
/// The bytes of a stored view: docs/formats/cache_record.md#payload.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/view/column_view.hpp"
#include "semview/view/view_profile.hpp"

namespace semview {

/// Names the coding in which views are stored; raised when the bytes change.
inline constexpr std::uint8_t kViewCodec = 2;

/// Whether `decode_view` can read a coding: this one and those before it.
constexpr bool knows_view_codec(std::uint8_t codec) { return codec == 1 || codec == kViewCodec; }

/// What a view's profile says about its runs.
struct ViewShape {
  int columns = 0;
  int rows = 0;
  bool ranges = false;

  bool operator==(const ViewShape&) const = default;
};
inline ViewShape shape_of(const ViewProfile& profile) {
  return {profile.camera.columns, profile.camera.rows, profile.ranges};
}

/// Codes a view, planes included, in `kViewCodec`. Equal views give equal bytes.
/// @cost 20 ns a symbol, some six hundred in a view; bench/storage_bench.cpp
std::vector<std::byte> encode_view(const ColumnView& view);

/// The shape that coded bytes say they have; none in codec 1, or if it can be no view's.
std::optional<ViewShape> claimed_shape(std::uint8_t codec, std::span<const std::byte> bytes);

/// The view coded in `bytes`, which may be damaged or hostile; equal to the one that was coded.
/// @errors kDataLoss: not the bytes of a view of that shape; kUnimplemented: an unknown codec.
Result<ColumnView> decode_view(std::uint8_t codec,
                               std::span<const std::byte> bytes,
                               const ViewShape& shape);

}  // namespace semview
