// SPDX-License-Identifier: Apache-2.0
#include "semview/view/view_codec_1.hpp"

#include <memory>
#include <optional>

#include <fmt/format.h>
#include <zstd.h>

#include "semview/core/check.hpp"

namespace semview::detail {
namespace {

// What a column is, in the stream of columns; docs/formats/cache_record.md#codec-1.
constexpr std::uint32_t kSameColumn = 0;  // runs as in the column before
constexpr std::uint32_t kMovedEnds = 1;   // labels as in the column before, other ends
constexpr std::uint32_t kNewRuns = 1;     // + the number of runs: all of them follow

constexpr int unzigzag(std::uint32_t value) {
  const int half = static_cast<int>(value / 2);
  return value % 2 == 0 ? half : -half - 1;
}

/// Takes bytes from the front; past the end everything is 0 and `failed()`.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::uint32_t byte() {
    if (bytes_.empty()) {
      failed_ = true;
      return 0;
    }
    const auto value = static_cast<std::uint32_t>(bytes_.front());
    bytes_ = bytes_.subspan(1);
    return value;
  }
  std::uint32_t varint() {
    std::uint32_t value = 0;
    for (unsigned shift = 0; shift < 28; shift += 7) {
      const std::uint32_t part = byte();
      value |= (part & 0x7fU) << shift;
      if ((part & 0x80U) == 0) return value;
    }
    failed_ = true;
    return 0;
  }
  Reader take(std::size_t count) {
    if (count > bytes_.size()) {
      failed_ = true;
      return Reader({});
    }
    const Reader part(bytes_.first(count));
    bytes_ = bytes_.subspan(count);
    return part;
  }
  bool failed() const { return failed_; }
  bool finished() const { return bytes_.empty() && !failed_; }

 private:
  std::span<const std::byte> bytes_;
  bool failed_ = false;
};

/// Puts the streams together again, column by column; all that a column says is checked here or by
/// `ColumnView::from_runs`.
class Joiner {
 public:
  Joiner(int columns, int rows) : rows_(rows) {
    first_run_.reserve(static_cast<std::size_t>(columns) + 1);
    first_run_.push_back(0);
  }

  bool add_column(Reader& columns, Reader& runs, Reader& moves) {
    const std::uint32_t kind = columns.varint();
    const std::size_t end = runs_.size();
    const std::size_t start = first_run_.size() < 2 ? end : first_run_[first_run_.size() - 2];
    if (kind == kSameColumn || kind == kMovedEnds) {
      if (start == end) return false;
      for (std::size_t i = start; i < end; ++i) {
        Run run = runs_[i];
        if (kind == kMovedEnds && i + 1 < end) {
          run.end_row = static_cast<std::uint16_t>(run.end_row + unzigzag(moves.varint()));
        }
        runs_.push_back(run);
      }
    } else {
      const std::uint32_t count = kind - kNewRuns;
      if (count > static_cast<std::uint32_t>(rows_)) return false;
      std::uint32_t row = 0;
      for (std::uint32_t i = 0; i < count; ++i) {
        const auto label = static_cast<ClassId>(runs.byte());
        row = i + 1 < count ? row + runs.varint() : static_cast<std::uint32_t>(rows_);
        if (row > static_cast<std::uint32_t>(rows_)) return false;
        runs_.push_back({static_cast<std::uint16_t>(row), label});
      }
    }
    first_run_.push_back(static_cast<std::uint32_t>(runs_.size()));
    return !columns.failed() && !runs.failed() && !moves.failed();
  }

  Result<ColumnView> finish() && {
    runs_.shrink_to_fit();
    return ColumnView::from_runs(rows_, std::move(first_run_), std::move(runs_));
  }

 private:
  int rows_;
  std::vector<std::uint32_t> first_run_;
  std::vector<Run> runs_;
};

struct FreeDecompressor {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

/// `nullopt` unless `bytes` is one frame of at most `limit` bytes of content.
std::optional<std::vector<std::byte>> decompress(std::span<const std::byte> bytes,
                                                 std::size_t limit) {
  thread_local const std::unique_ptr<ZSTD_DCtx, FreeDecompressor> context(ZSTD_createDCtx());
  SEMVIEW_CHECK(context != nullptr);
  const unsigned long long content = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  // The two error values are larger than any limit.
  if (content > limit) return std::nullopt;
  std::vector<std::byte> body(static_cast<std::size_t>(content));
  const std::size_t size =
      ZSTD_decompressDCtx(context.get(), body.data(), body.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size) != 0U || size != body.size()) return std::nullopt;
  return body;
}

}  // namespace

Result<ColumnView> decode_view_1(std::span<const std::byte> bytes, int columns, int rows) {
  // No run takes more than 6 bytes: label, length, or a move; no column's kind more than 4.
  const auto limit = static_cast<std::size_t>(columns) * (static_cast<std::size_t>(rows) * 6 + 4);
  const std::optional<std::vector<std::byte>> body = decompress(bytes, limit + 8);
  if (!body) return fail(ErrorCode::kDataLoss, "view: payload is not a zstd frame of its size");
  Reader moves(*body);
  const std::uint32_t columns_size = moves.varint();
  const std::uint32_t runs_size = moves.varint();
  Reader column_kinds = moves.take(columns_size);
  Reader runs = moves.take(runs_size);
  Joiner joiner(columns, rows);
  for (int c = 0; c < columns; ++c) {
    if (moves.failed() || !joiner.add_column(column_kinds, runs, moves)) {
      return fail(ErrorCode::kDataLoss, fmt::format("view: column {} is damaged", c));
    }
  }
  if (!column_kinds.finished() || !runs.finished() || !moves.finished()) {
    return fail(ErrorCode::kDataLoss, "view: bytes behind the last column");
  }
  return std::move(joiner).finish();
}

}  // namespace semview::detail
