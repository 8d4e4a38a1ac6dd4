// SPDX-License-Identifier: Apache-2.0
/// Codec 2 of stored views, docs/formats/cache_record.md#codec-2; for the sources of this module.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/view/column_view.hpp"
#include "semview/view/view_codec.hpp"
#include "semview/view/view_symbols.hpp"

namespace semview::detail {

/// What is told of a view's runs, in order.
SymbolWriter symbols_of(const ColumnView& view);

std::vector<std::byte> encode_view_2(const ColumnView& view);
std::optional<ViewShape> claimed_shape_2(std::span<const std::byte> bytes);
/// @errors kDataLoss: not the bytes of a view of that shape.
Result<ColumnView> decode_view_2(std::span<const std::byte> bytes, const ViewShape& shape);

}  // namespace semview::detail
