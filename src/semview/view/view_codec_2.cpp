// SPDX-License-Identifier: Apache-2.0
#include "semview/view/view_codec_2.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "semview/view/plane_model.hpp"
#include "semview/view/range_coder.hpp"
#include "semview/view/view_model.hpp"

namespace semview::detail {
namespace {

constexpr unsigned kColumnsBits = 12;
constexpr unsigned kRowsBits = 11;
static_assert(kMaxPanoramaColumns < 1 << kColumnsBits && kMaxPanoramaRows < 1 << kRowsBits);

/// Writes the shape that a view has, or reads it.
template <typename Coder>
ViewShape code_shape(Coder& coder, const ViewShape& shape) {
  ViewShape coded;
  coded.columns =
      static_cast<int>(coder.code_plain(static_cast<std::uint32_t>(shape.columns), kColumnsBits));
  coded.rows =
      static_cast<int>(coder.code_plain(static_cast<std::uint32_t>(shape.rows), kRowsBits));
  coded.ranges = coder.code_plain(shape.ranges ? 1 : 0, 1) != 0;
  return coded;
}

/// A column that is not as the one to its left.
struct ChangedColumn {
  int column;
  bool fresh;  ///< of other classes, or more or fewer
  /// If not: for each edge a bit that says whether it is elsewhere; the last one for all from the
  /// 64th on.
  std::uint64_t moved;
};

struct ChangedColumns {
  std::unique_ptr<ChangedColumn[]> columns;
  std::size_t count = 0;

  std::span<const ChangedColumn> span() const { return {columns.get(), count}; }
};

/// In order; the first column is fresh. Without a branch on whether edges moved: a view has a
/// hundred moves, and no processor can foresee them.
ChangedColumns changed_columns(const ColumnView& view) {
  ChangedColumns changed;
  changed.columns =
      std::make_unique_for_overwrite<ChangedColumn[]>(static_cast<std::size_t>(view.columns()));
  changed.columns[changed.count++] = {0, true, 0};
  std::span<const Run> left = view.column(0);
  for (int c = 1; c < view.columns(); ++c) {
    const std::span<const Run> column = view.column(c);
    bool fresh = left.size() != column.size();
    std::uint64_t moved = 0;
    for (std::size_t i = 0; !fresh && i < column.size(); ++i) {
      fresh = left[i].label != column[i].label;
      const bool moves = left[i].end_row != column[i].end_row;
      moved |= std::uint64_t{moves} << std::min<std::size_t>(i, 63);
    }
    changed.columns[changed.count] = {c, fresh, moved};
    changed.count += fresh || moved != 0 ? 1 : 0;
    left = column;
  }
  return changed;
}

/// At most so many symbols tell a column: a class in two, an end in two and a gap of each run, and
/// the gap to the next fresh one; or a step and a gap of each.
std::size_t most_symbols(std::size_t runs, bool fresh) { return fresh ? 5 * runs + 1 : 2 * runs; }

/// The runs of a view as they are read.
struct Runs {
  std::vector<std::uint32_t> first_run = {0};
  std::vector<Run> runs;

  void add(std::span<const Edge> edges) {
    for (const Edge& edge : edges) {
      runs.push_back({static_cast<std::uint16_t>(edge.row), edge.label});
    }
    first_run.push_back(static_cast<std::uint32_t>(runs.size()));
  }
  void repeat_last() {
    const std::size_t end = runs.size();
    const std::size_t count = end - first_run[first_run.size() - 2];
    runs.resize(end + count);
    std::copy_n(&runs[end - count], count, &runs[end]);
    first_run.push_back(static_cast<std::uint32_t>(runs.size()));
  }
};

/// @returns the first column that is damaged.
std::optional<int> decode_runs(RangeDecoder& decoder, const ViewShape& shape, Runs& runs) {
  runs.first_run.reserve(static_cast<std::size_t>(shape.columns) + 1);
  runs.runs.reserve(static_cast<std::size_t>(shape.columns) * 4);
  SymbolReader reader(decoder);
  ColumnWalk walk(reader, shape.columns, shape.rows, shape.ranges);
  for (int c = 0; c < shape.columns; ++c) {
    if (c == walk.next_fresh()) {
      if (!walk.code_fresh(c, {}, 0)) return c;
    } else if (walk.next_move() == static_cast<std::uint32_t>(c)) {
      if (!walk.read_moves(c)) return c;
    } else {
      runs.repeat_last();
      continue;
    }
    runs.add(walk.edges());
  }
  return std::nullopt;
}

}  // namespace

SymbolWriter symbols_of(const ColumnView& view) {
  const ChangedColumns found = changed_columns(view);
  const std::span<const ChangedColumn> changed = found.span();
  std::size_t most = 0;
  for (const ChangedColumn& change : changed) {
    most += most_symbols(view.column(change.column).size(), change.fresh);
  }
  SymbolWriter writer(most);
  ColumnWalk walk(writer, view.columns(), view.rows(), view.has_ranges());
  for (std::size_t i = 0; i < changed.size(); ++i) {
    const auto [column, fresh, moved] = changed[i];
    if (!fresh) {
      walk.write_moves(column, view.column(column), moved);
      continue;
    }
    std::size_t next = i + 1;
    while (next < changed.size() && !changed[next].fresh) ++next;
    const int next_fresh = next < changed.size() ? changed[next].column : view.columns();
    walk.code_fresh(column, view.column(column), next_fresh - column);
  }
  return writer;
}

std::vector<std::byte> encode_view_2(const ColumnView& view) {
  RangeEncoder encoder;
  encoder.reserve(view.runs().size() / 2 + 16);
  code_shape(encoder, {view.columns(), view.rows(), view.has_ranges()});
  symbols_of(view).write(encoder);
  if (view.has_ranges()) {
    std::vector<RunPlane> planes(view.planes().begin(), view.planes().end());
    PlaneModel(view.columns()).code(encoder, view.first_run(), view.runs(), planes);
  }
  return std::move(encoder).finish();
}

std::optional<ViewShape> claimed_shape_2(std::span<const std::byte> bytes) {
  RangeDecoder decoder(bytes);
  const ViewShape shape = code_shape(decoder, {});
  const bool possible = shape.columns > 0 && shape.columns <= kMaxPanoramaColumns &&
                        shape.rows > 0 && shape.rows <= kMaxPanoramaRows;
  return possible ? std::optional(shape) : std::nullopt;
}

Result<ColumnView> decode_view_2(std::span<const std::byte> bytes, const ViewShape& shape) {
  RangeDecoder decoder(bytes);
  if (code_shape(decoder, {}) != shape) return fail(ErrorCode::kDataLoss, "view: another shape");
  Runs runs;
  if (const auto damaged = decode_runs(decoder, shape, runs)) {
    return fail(ErrorCode::kDataLoss, fmt::format("view: column {} is damaged", *damaged));
  }
  std::vector<RunPlane> planes;
  if (shape.ranges) {
    planes.resize(runs.runs.size());
    PlaneModel(shape.columns).code(decoder, runs.first_run, runs.runs, planes);
  }
  if (!decoder.finished()) return fail(ErrorCode::kDataLoss, "view: bytes behind the last column");
  // The memory tier keeps it as it is.
  runs.runs.shrink_to_fit();
  return ColumnView::from_runs(
      shape.rows, std::move(runs.first_run), std::move(runs.runs), std::move(planes));
}

}  // namespace semview::detail
