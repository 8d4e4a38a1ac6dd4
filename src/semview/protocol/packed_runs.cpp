// SPDX-License-Identifier: Apache-2.0
#include "semview/protocol/packed_runs.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace semview::protocol {
namespace {

constexpr std::size_t kPlaneBytes = 8;
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

/// Whether a column is the one before it once more.
bool repeats(const ColumnView& view, int c) {
  return c > 0 && std::ranges::equal(view.column(c), view.column(c - 1)) &&
         std::ranges::equal(view.column_planes(c), view.column_planes(c - 1));
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
  for (int c = 0; c < view.columns(); ++c) {
    const std::span<const Run> column = view.column(c);
    if (repeats(view, c)) continue;
    put<kBytes>(bytes.data() + static_cast<std::size_t>(c) * kBytes,
                static_cast<std::uint32_t>(column.size()));
    for (const Run& run : column) {
      put<kBytes>(end_rows, run.end_row);
      end_rows += kBytes;
      *label++ = static_cast<char>(run.label);
    }
  }
  const auto runs = static_cast<std::size_t>(label - labels.data());
  std::copy(labels.data(), label, end_rows);
  bytes.resize(head + runs * (kBytes + 1));
  return bytes;
}

/// The columns that bring runs of their own are read as a view, and checked as one; the others
/// repeat them.
template <std::size_t kBytes>
Result<ColumnView> unpack(std::string_view bytes, int rows, int columns, std::string_view planes) {
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
  SEMVIEW_TRY(std::vector<RunPlane> planes_of_runs, planes_from_bytes(planes, runs_count));
  SEMVIEW_TRY(const ColumnView distinct,
              ColumnView::from_runs(
                  rows, std::move(first_run), std::move(runs), std::move(planes_of_runs)));
  return distinct.arranged(source);
}

}  // namespace

std::string pack_runs(const ColumnView& view) {
  return view.rows() <= kMaxRowsOfOneByte ? pack<1>(view) : pack<2>(view);
}

std::string pack_planes(const ColumnView& view) {
  std::string bytes;
  if (!view.has_ranges()) return bytes;
  bytes.reserve(view.planes().size() * kPlaneBytes);
  for (int c = 0; c < view.columns(); ++c) {
    if (!repeats(view, c)) bytes += planes_to_bytes(view.column_planes(c));
  }
  return bytes;
}

Result<ColumnView> unpack_runs(std::string_view bytes,
                               int rows,
                               int columns,
                               std::string_view planes) {
  return rows <= kMaxRowsOfOneByte ? unpack<1>(bytes, rows, columns, planes)
                                   : unpack<2>(bytes, rows, columns, planes);
}

std::string planes_to_bytes(std::span<const RunPlane> planes) {
  std::string bytes(planes.size() * kPlaneBytes, '\0');
  for (std::size_t i = 0; i < planes.size(); ++i) {
    char* const to = bytes.data() + i * kPlaneBytes;
    put<4>(to, std::bit_cast<std::uint32_t>(planes[i].a_per_m));
    put<4>(to + 4, std::bit_cast<std::uint32_t>(planes[i].b_per_m));
  }
  return bytes;
}

Result<std::vector<RunPlane>> planes_from_bytes(std::string_view bytes, std::size_t count) {
  if (bytes.empty()) return std::vector<RunPlane>();
  if (bytes.size() != count * kPlaneBytes) {
    return fail(ErrorCode::kDataLoss,
                fmt::format("view: planes of {} bytes; expected {} planes of {} bytes",
                            bytes.size(),
                            count,
                            kPlaneBytes));
  }
  std::vector<RunPlane> planes(count);
  for (std::size_t i = 0; i < count; ++i) {
    const char* const from = bytes.data() + i * kPlaneBytes;
    planes[i] = {std::bit_cast<float>(get<4>(from)), std::bit_cast<float>(get<4>(from + 4))};
  }
  return planes;
}

}  // namespace semview::protocol
