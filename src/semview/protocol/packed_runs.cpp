// SPDX-License-Identifier: Apache-2.0
#include "semview/protocol/packed_runs.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

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
std::string pack(const ColumnView& view) {
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
    const std::span<const Run> column = view.column(c);
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

/// The columns that bring runs of their own are read as a view, and checked as one; the others
/// repeat them.
template <std::size_t kBytes>
Result<ColumnView> unpack(std::string_view bytes, int rows, int columns) {
  const auto count_of_columns = static_cast<std::size_t>(columns);
  const std::size_t head = count_of_columns * kBytes;
  if (columns < 1 || bytes.size() < head) {
    return fail(ErrorCode::kDataLoss,
                fmt::format("view: {} bytes; expected {} columns", bytes.size(), columns));
  }
  std::vector<std::uint32_t> first_run(count_of_columns + 1);
  thread_local std::vector<std::uint32_t> source;
  source.resize(count_of_columns);
  std::size_t own = 0;
  std::uint32_t runs_count = 0;
  for (std::size_t c = 0; c < count_of_columns; ++c) {
    const std::uint32_t count = get<kBytes>(bytes.data() + c * kBytes);
    own += count == 0 ? 0 : 1;
    runs_count += count;
    source[c] = static_cast<std::uint32_t>(own) - 1;
    first_run[own] = runs_count;
  }
  if (bytes.size() != head + runs_count * (kBytes + 1) || source.front() != 0) {
    return fail(ErrorCode::kDataLoss,
                fmt::format("view: {} bytes; expected {} columns, the first with runs, and {} runs "
                            "of {} bytes",
                            bytes.size(),
                            columns,
                            runs_count,
                            kBytes + 1));
  }
  first_run.resize(own + 1);
  std::vector<Run> runs(runs_count);
  const char* const end_rows = bytes.data() + head;
  const char* const labels = end_rows + runs_count * kBytes;
  for (std::size_t i = 0; i < runs_count; ++i) {
    runs[i] = {static_cast<std::uint16_t>(get<kBytes>(end_rows + i * kBytes)),
               static_cast<ClassId>(labels[i])};
  }
  SEMVIEW_TRY(const ColumnView distinct,
              ColumnView::from_runs(rows, std::move(first_run), std::move(runs)));
  return distinct.arranged(source);
}

}  // namespace

std::string pack_runs(const ColumnView& view) {
  return view.rows() <= kMaxRowsOfOneByte ? pack<1>(view) : pack<2>(view);
}

Result<ColumnView> unpack_runs(std::string_view bytes, int rows, int columns) {
  return rows <= kMaxRowsOfOneByte ? unpack<1>(bytes, rows, columns)
                                   : unpack<2>(bytes, rows, columns);
}

}  // namespace semview::protocol
