// SPDX-License-Identifier: Apache-2.0
/// The coding of views stored by semview 0.1: docs/formats/cache_record.md#codec-1. It is read so
/// that caches keep serving, and written no more.
#pragma once

#include <cstddef>
#include <span>

#include "semview/core/result.hpp"
#include "semview/view/column_view.hpp"

namespace semview::detail {

/// @errors kDataLoss: not the bytes of a view of `columns` × `rows`.
Result<ColumnView> decode_view_1(std::span<const std::byte> bytes, int columns, int rows);

}  // namespace semview::detail
