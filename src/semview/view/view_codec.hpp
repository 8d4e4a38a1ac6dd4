// SPDX-License-Identifier: Apache-2.0
/// The bytes of a stored view: docs/formats/cache_record.md#payload.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/view/column_view.hpp"

namespace semview {

/// Names the coding below in stored records; raised when the bytes change.
inline constexpr std::uint8_t kViewCodec = 1;

/// Codes a view: each column's runs as differences to the column before, then zstd. Equal views
/// give equal bytes (with one version of zstd).
std::vector<std::byte> encode_view(const ColumnView& view);

/// The view coded in `bytes`, which may be damaged or hostile.
/// @errors kDataLoss: not the bytes of a view of `columns` × `rows`.
Result<ColumnView> decode_view(std::span<const std::byte> bytes, int columns, int rows);

}  // namespace semview
