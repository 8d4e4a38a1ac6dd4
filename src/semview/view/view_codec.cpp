// SPDX-License-Identifier: Apache-2.0
#include "semview/view/view_codec.hpp"

#include <utility>

#include <fmt/format.h>

#include "semview/view/range_coder.hpp"
#include "semview/view/view_codec_1.hpp"
#include "semview/view/view_model.hpp"

namespace semview {
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

Result<ColumnView> decode_view_2(std::span<const std::byte> bytes, const ViewShape& shape) {
  detail::RangeDecoder decoder(bytes);
  if (code_shape(decoder, {}) != shape) return fail(ErrorCode::kDataLoss, "view: another shape");
  detail::ColumnWalk walk(decoder, shape.columns, shape.rows, shape.ranges);
  std::vector<std::uint32_t> first_run;
  std::vector<Run> runs;
  std::vector<RunPlane> planes;
  first_run.reserve(static_cast<std::size_t>(shape.columns) + 1);
  runs.reserve(static_cast<std::size_t>(shape.columns) * 4);
  first_run.push_back(0);
  for (int c = 0; c < shape.columns; ++c) {
    if (!walk.code_column({}, {})) {
      return fail(ErrorCode::kDataLoss, fmt::format("view: column {} is damaged", c));
    }
    for (const detail::Edge& edge : walk.edges()) {
      runs.push_back({static_cast<std::uint16_t>(edge.row), edge.label});
    }
    for (const detail::PlaneState& state : walk.planes()) planes.push_back(state.plane);
    first_run.push_back(static_cast<std::uint32_t>(runs.size()));
  }
  if (!decoder.finished()) return fail(ErrorCode::kDataLoss, "view: bytes behind the last column");
  // The memory tier keeps it as it is.
  runs.shrink_to_fit();
  planes.shrink_to_fit();
  return ColumnView::from_runs(
      shape.rows, std::move(first_run), std::move(runs), std::move(planes));
}

}  // namespace

std::vector<std::byte> encode_view(const ColumnView& view) {
  detail::RangeEncoder encoder;
  encoder.reserve(view.runs().size() / 2 + 16);
  code_shape(encoder, {view.columns(), view.rows(), view.has_ranges()});
  detail::ColumnWalk walk(encoder, view.columns(), view.rows(), view.has_ranges());
  for (int c = 0; c < view.columns(); ++c) {
    walk.code_column(view.column(c), view.column_planes(c));
  }
  return std::move(encoder).finish();
}

std::optional<ViewShape> claimed_shape(std::uint8_t codec, std::span<const std::byte> bytes) {
  if (codec != kViewCodec) return std::nullopt;
  detail::RangeDecoder decoder(bytes);
  const ViewShape shape = code_shape(decoder, {});
  const bool possible = shape.columns > 0 && shape.columns <= kMaxPanoramaColumns &&
                        shape.rows > 0 && shape.rows <= kMaxPanoramaRows;
  return possible ? std::optional(shape) : std::nullopt;
}

Result<ColumnView> decode_view(std::uint8_t codec,
                               std::span<const std::byte> bytes,
                               const ViewShape& shape) {
  if (codec == kViewCodec) return decode_view_2(bytes, shape);
  if (codec == 1 && !shape.ranges) return detail::decode_view_1(bytes, shape.columns, shape.rows);
  return fail(ErrorCode::kUnimplemented,
              fmt::format("view: codec {}, this program knows 1 and {}", codec, kViewCodec));
}

}  // namespace semview
