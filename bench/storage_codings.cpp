// SPDX-License-Identifier: Apache-2.0
#include "storage_codings.hpp"

#include <algorithm>
#include <cstdint>

#include <zdict.h>
#include <zstd.h>

namespace semview::bench {
namespace {

void add_varint(Bytes& out, std::uint32_t value) {
  for (; value >= 0x80; value >>= 7U) out.push_back(static_cast<std::byte>(0x80 | (value & 0x7f)));
  out.push_back(static_cast<std::byte>(value));
}

std::uint32_t zigzag(int value) {
  return value < 0 ? 2 * static_cast<std::uint32_t>(-value) - 1
                   : 2 * static_cast<std::uint32_t>(value);
}

bool same_labels(std::span<const Run> a, std::span<const Run> b) {
  return std::ranges::equal(a, b, {}, &Run::label, &Run::label);
}

}  // namespace

Bytes pixels(const ColumnView& view) {
  Bytes bytes;
  for (int c = 0; c < view.columns(); ++c) {
    const std::size_t start = bytes.size();
    for (const Run& run : view.column(c)) {
      bytes.resize(start + run.end_row, static_cast<std::byte>(run.label));
    }
  }
  return bytes;
}

Bytes plain_runs(const ColumnView& view) {
  Bytes bytes;
  for (int c = 0; c < view.columns(); ++c) {
    add_varint(bytes, static_cast<std::uint32_t>(view.column(c).size()));
    std::uint32_t start = 0;
    for (const Run& run : view.column(c)) {
      bytes.push_back(static_cast<std::byte>(run.label));
      add_varint(bytes, run.end_row - start);
      start = run.end_row;
    }
  }
  return bytes;
}

Bytes delta_runs(const ColumnView& view) {
  Bytes columns, runs, moves;
  std::span<const Run> before;
  for (int c = 0; c < view.columns(); ++c) {
    const std::span<const Run> column = view.column(c);
    if (!same_labels(column, before)) {
      add_varint(columns, 1 + static_cast<std::uint32_t>(column.size()));
      std::uint32_t start = 0;
      for (const Run& run : column) {
        runs.push_back(static_cast<std::byte>(run.label));
        if (&run != &column.back()) add_varint(runs, run.end_row - start);
        start = run.end_row;
      }
    } else if (std::ranges::equal(column, before)) {
      add_varint(columns, 0);
    } else {
      add_varint(columns, 1);
      for (std::size_t i = 0; i + 1 < column.size(); ++i) {
        add_varint(moves, zigzag(column[i].end_row - before[i].end_row));
      }
    }
    before = column;
  }
  Bytes bytes;
  add_varint(bytes, static_cast<std::uint32_t>(columns.size()));
  add_varint(bytes, static_cast<std::uint32_t>(runs.size()));
  for (const Bytes* stream : {&columns, &runs, &moves}) {
    bytes.insert(bytes.end(), stream->begin(), stream->end());
  }
  return bytes;
}

Zstd::Zstd(int level, std::span<const std::byte> dictionary)
    : compressor_(ZSTD_createCCtx(), ZSTD_freeCCtx),
      decompressor_(ZSTD_createDCtx(), ZSTD_freeDCtx),
      compressing_(ZSTD_createCDict(dictionary.data(), dictionary.size(), level), ZSTD_freeCDict),
      decompressing_(ZSTD_createDDict(dictionary.data(), dictionary.size()), ZSTD_freeDDict) {}

Bytes Zstd::compress(std::span<const std::byte> bytes) {
  Bytes out(ZSTD_compressBound(bytes.size()));
  out.resize(ZSTD_compress_usingCDict(
      compressor_.get(), out.data(), out.size(), bytes.data(), bytes.size(), compressing_.get()));
  return out;
}

Bytes Zstd::decompress(std::span<const std::byte> bytes) {
  Bytes out(ZSTD_getFrameContentSize(bytes.data(), bytes.size()));
  out.resize(ZSTD_decompress_usingDDict(decompressor_.get(),
                                        out.data(),
                                        out.size(),
                                        bytes.data(),
                                        bytes.size(),
                                        decompressing_.get()));
  return out;
}

Bytes train_dictionary(const std::vector<Bytes>& samples) {
  Bytes joined;
  std::vector<std::size_t> sizes;
  for (const Bytes& sample : samples) {
    joined.insert(joined.end(), sample.begin(), sample.end());
    sizes.push_back(sample.size());
  }
  Bytes dictionary(16384);
  const std::size_t size = ZDICT_trainFromBuffer(dictionary.data(),
                                                 dictionary.size(),
                                                 joined.data(),
                                                 sizes.data(),
                                                 static_cast<unsigned>(sizes.size()));
  dictionary.resize(ZDICT_isError(size) != 0U ? 0 : size);
  return dictionary;
}

}  // namespace semview::bench
