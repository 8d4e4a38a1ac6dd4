// SPDX-License-Identifier: Apache-2.0
#include "semview/protocol/packed_runs.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/geometry/pose_grid.hpp"

namespace semview::protocol {
namespace {

/// Counts and rows of a view of so many rows take one byte, else two.
constexpr int kMaxRowsOfOneByte = std::numeric_limits<std::uint8_t>::max();

/// Little endian, on any machine.
template <std::size_t kBytes>
void put(char* to, std::uint32_t number) {
  for (std::size_t i = 0; i < kBytes; ++i) to[i] = static_cast<char>(number >> (8 * i));
}
template <std::size_t kBytes>
std::uint32_t get(const char* from) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < kBytes; ++i) {
    number |= std::uint32_t{static_cast<std::uint8_t>(from[i])} << (8 * i);
  }
  return number;
}

template <std::size_t kBytes>
std::string pack(const ColumnView& view, int heading) {
  const auto columns = static_cast<std::size_t>(view.columns());
  const std::size_t head = columns * kBytes;
  // Room for all runs; repeated columns leave some of it.
  std::string bytes(head + view.runs().size() * (kBytes + 1), '\0');
  thread_local std::vector<char> labels;
  labels.resize(view.runs().size());
  char* end_rows = bytes.data() + head;
  char* label = labels.data();
  std::span<const Run> before;
  for (int c = 0; c < view.columns(); ++c) {
    const std::span<const Run> column =
        view.column(heading == 0 ? c : PoseGrid::source_column(c, heading, view.columns()));
    if (std::ranges::equal(column, before)) continue;
    put<kBytes>(bytes.data() + static_cast<std::size_t>(c) * kBytes,
                static_cast<std::uint32_t>(column.size()));
    for (const Run& run : column) {
      put<kBytes>(end_rows, run.end_row);
      end_rows += kBytes;
      *label++ = static_cast<char>(run.label);
    }
    before = column;
  }
  const auto runs = static_cast<std::size_t>(label - labels.data());
  std::copy(labels.data(), label, end_rows);
  bytes.resize(head + runs * (kBytes + 1));
  return bytes;
}

template <std::size_t kBytes>
Result<ColumnView> unpack(std::string_view bytes, int rows, int columns) {
  const std::size_t head = static_cast<std::size_t>(columns) * kBytes;
  std::size_t sent = 0;      // runs of columns that bring their own
  std::size_t all = 0;       // and of those that repeat the one before
  std::uint32_t before = 0;  // runs of the column before
  for (std::size_t at = 0; at + kBytes <= std::min(head, bytes.size()); at += kBytes) {
    const std::uint32_t count = get<kBytes>(bytes.data() + at);
    // Else few bytes could ask for much memory.
    if (count > static_cast<std::uint32_t>(rows)) {
      return fail(
          ErrorCode::kDataLoss,
          fmt::format("view: column {} of {} runs; it has {} rows", at / kBytes, count, rows));
    }
    if (count > 0) before = count;
    sent += count;
    all += before;
  }
  if (bytes.size() != head + sent * (kBytes + 1)) {
    return fail(ErrorCode::kDataLoss,
                fmt::format("view: {} bytes; expected {} columns and {} runs of {} bytes",
                            bytes.size(),
                            columns,
                            sent,
                            kBytes + 1));
  }
  const char* end_row = bytes.data() + head;
  const char* label = end_row + sent * kBytes;
  std::vector<std::uint32_t> first_run(static_cast<std::size_t>(columns) + 1);
  std::vector<Run> runs(all);
  Run* next = runs.data();
  before = 0;
  for (std::size_t c = 0; c < static_cast<std::size_t>(columns); ++c) {
    first_run[c] = static_cast<std::uint32_t>(next - runs.data());
    const std::uint32_t count = get<kBytes>(bytes.data() + c * kBytes);
    if (count == 0) {
      next = std::copy_n(next - before, before, next);
      continue;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      *next++ = {static_cast<std::uint16_t>(get<kBytes>(end_row)), static_cast<ClassId>(*label++)};
      end_row += kBytes;
    }
    before = count;
  }
  first_run.back() = static_cast<std::uint32_t>(all);
  return ColumnView::from_runs(rows, std::move(first_run), std::move(runs));
}

}  // namespace

std::string pack_runs(const ColumnView& view, int heading) {
  SEMVIEW_CHECK(heading == 0 || view.columns() % PoseGrid::kHeadings == 0);
  return view.rows() <= kMaxRowsOfOneByte ? pack<1>(view, heading) : pack<2>(view, heading);
}

Result<ColumnView> unpack_runs(std::string_view bytes, int rows, int columns) {
  return rows <= kMaxRowsOfOneByte ? unpack<1>(bytes, rows, columns)
                                   : unpack<2>(bytes, rows, columns);
}

}  // namespace semview::protocol
