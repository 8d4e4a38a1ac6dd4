// SPDX-License-Identifier: Apache-2.0
/// Ways to store views that the product does not use, to compare it with: bench/storage_bench.cpp.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "semview/view/column_view.hpp"

struct ZSTD_CCtx_s;
struct ZSTD_DCtx_s;
struct ZSTD_CDict_s;
struct ZSTD_DDict_s;

namespace semview::bench {

using Bytes = std::vector<std::byte>;

Bytes pixels(const ColumnView& view);      ///< one byte a pixel, column by column
Bytes plain_runs(const ColumnView& view);  ///< class and length of each run
Bytes delta_runs(const ColumnView& view);  ///< codec 1 before zstd: docs/formats/cache_record.md

/// zstd at one level, with a dictionary or without.
class Zstd {
 public:
  explicit Zstd(int level, std::span<const std::byte> dictionary = {});

  Bytes compress(std::span<const std::byte> bytes);
  Bytes decompress(std::span<const std::byte> bytes);

 private:
  std::shared_ptr<ZSTD_CCtx_s> compressor_;
  std::shared_ptr<ZSTD_DCtx_s> decompressor_;
  std::shared_ptr<ZSTD_CDict_s> compressing_;
  std::shared_ptr<ZSTD_DDict_s> decompressing_;
};

/// A dictionary of 16 kB for bytes like these.
Bytes train_dictionary(const std::vector<Bytes>& samples);

}  // namespace semview::bench
