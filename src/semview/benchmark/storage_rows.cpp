// SPDX-License-Identifier: Apache-2.0
// What a stored view costs, in bytes and in time.
#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <zstd.h>

#include "semview/benchmark/measurement.hpp"
#include "semview/view/view_codec.hpp"

namespace semview::benchmark::detail {
namespace {

std::vector<ColumnView> cast_views(const Circumstances& in) {
  std::vector<ColumnView> views;
  for (const CellIndex& cell : in.subject.sample(in.extent.stored_cells)) {
    views.push_back(in.subject.runs(in.subject.request(cell, in.camera)));
  }
  return views;
}

/// Of a view; they are the same in every round.
Finding finding_of_bytes(double ours, double other, std::string agreement) {
  return {.unit = "B",
          .ours = ours,
          .ours_median = ours,
          .other = other,
          .other_median = other,
          .ratio = other / ours,
          .ratio_median = other / ours,
          .rounds = 1,
          .clock = "",
          .agreement = std::move(agreement)};
}

/// Bytes of the pixels after zstd at its usual level.
std::size_t zstd_bytes(const LabelImage& pixels) {
  std::vector<char> packed(ZSTD_compressBound(pixels.pixels().size()));
  return ZSTD_compress(
      packed.data(), packed.size(), pixels.pixels().data(), pixels.pixels().size(), 3);
}

Status stored_bytes(const Circumstances& in, Row& row) {
  const std::vector<ColumnView> views = cast_views(in);
  double ours = 0.0, other = 0.0;
  for (const ColumnView& view : views) {
    const std::vector<std::byte> coded = encode_view(view);
    const auto decoded =
        decode_view(kViewCodec, coded, {view.columns(), view.rows(), view.has_ranges()});
    if (!decoded || *decoded != view) {
      return fail(ErrorCode::kInternal, "results differ: a view and what was stored of it");
    }
    ours += static_cast<double>(coded.size());
    other += static_cast<double>(zstd_bytes(view.to_labels(0)));
  }
  const auto count = static_cast<double>(views.size());
  row.found = finding_of_bytes(
      ours / count, other / count, fmt::format("{} views read back equal", views.size()));
  return {};
}

/// What the memory tier holds of a view.
Status held_bytes(const Circumstances& in, Row& row) {
  const std::vector<ColumnView> views = cast_views(in);
  double ours = 0.0;
  for (const ColumnView& view : views) ours += static_cast<double>(view.byte_size());
  ours /= static_cast<double>(views.size());
  const double pixels = static_cast<double>(in.camera.columns) * in.camera.rows;
  row.found = finding_of_bytes(ours, pixels, "the scorer's form");
  return {};
}

}  // namespace

std::vector<RowKind> storage_rows() {
  return {
      {"bytes",
       "stored bytes a view; pixels and zstd",
       {{"at most 330 B, then 250 B", 330.0, 250.0, true, true}},
       Plans::kAll,
       true,
       stored_bytes},
      {"held", "memory of a view as runs; as pixels", {}, Plans::kAll, true, held_bytes},
  };
}

}  // namespace semview::benchmark::detail
