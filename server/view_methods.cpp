// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iterator>
#include <mutex>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "methods.hpp"
#include "semview/geometry/pinhole_camera.hpp"
#include "semview/protocol/envelope.hpp"
#include "semview/protocol/map_wire.hpp"
#include "semview/protocol/view_wire.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/raycast/pinhole_renderer.hpp"

namespace semview::server {
namespace {

using SharedSite = std::shared_ptr<service::Site>;

/// Pixels of a default panorama: what one cell of estimated work stands for.
constexpr std::uint64_t kPixelsPerCell = 360 * 90;

struct Encoding {
  bool runs = true;
  bool ranges = false;
};

/// @errors kInvalidArgument, kResourceExhausted: what was asked cannot be sent.
Result<Encoding> encoding_of(const v1::GetViewsRequest& wire) {
  const bool grid = wire.has_cells() || wire.has_poses();
  if (wire.encoding() < v1::VIEW_ENCODING_UNSPECIFIED ||
      wire.encoding() > v1::VIEW_ENCODING_PIXELS) {
    return protocol::wrong_field(
        "encoding", fmt::format("{} is not an encoding", static_cast<int>(wire.encoding())));
  }
  if (grid && wire.with_ranges()) {
    return protocol::wrong_field("with_ranges", "views of the grid are stored without ranges");
  }
  if (wire.has_pinholes() && wire.encoding() == v1::VIEW_ENCODING_RUNS) {
    return protocol::wrong_field("encoding", "a pinhole image comes as pixels only");
  }
  return Encoding{!wire.has_pinholes() && wire.encoding() != v1::VIEW_ENCODING_PIXELS,
                  wire.with_ranges()};
}

/// Refuses more pixels than one reply may hold. Runs are a tenth of the pixels and not counted
/// apart; a range counts as four label pixels, being four bytes.
Status check_pixels(const service::Limits& limits,
                    std::size_t views,
                    int rows,
                    int columns,
                    const Encoding& encoding,
                    bool exact) {
  const std::uint64_t one = static_cast<std::uint64_t>(rows) * static_cast<std::uint64_t>(columns);
  if (exact && one > limits.max_pixels) {
    return fail(
        Error{ErrorCode::kResourceExhausted,
              fmt::format(
                  "rows: {} × {} pixels; at most {} in one view", rows, columns, limits.max_pixels),
              "rows"});
  }
  const std::uint64_t total = one * views * (encoding.ranges ? 5 : 1);
  if (total > limits.max_request_pixels) {
    return fail(Error{ErrorCode::kResourceExhausted,
                      fmt::format("{} views of {} × {} pixels{}; at most {} in one request",
                                  views,
                                  rows,
                                  columns,
                                  encoding.ranges ? " with ranges, which count as four" : "",
                                  limits.max_request_pixels),
                      "poses",
                      "split the request"});
  }
  return {};
}

/// The same panorama turned to a heading of the grid, as runs.
ColumnView turned(const ColumnView& view, int heading) {
  std::vector<std::uint32_t> first_run{0};
  std::vector<Run> runs;
  runs.reserve(view.runs().size());
  for (int c = 0; c < view.columns(); ++c) {
    const auto source = view.column(PoseGrid::source_column(c, heading, view.columns()));
    runs.insert(runs.end(), source.begin(), source.end());
    first_run.push_back(static_cast<std::uint32_t>(runs.size()));
  }
  // Its columns are those of a sound view.
  return *ColumnView::from_runs(view.rows(), std::move(first_run), std::move(runs));
}

/// A GetViews under way; each chunk fills its own part of `views`.
struct Viewing {
  SharedSite site;
  Encoding encoding;
  std::vector<v1::View> views;
  int rows = 0;
  int columns = 0;
  std::mutex mutex;  ///< guards origins
  ViewOrigins origins;

  // Of views of the grid: distinct cells, and for each view which of them, at which heading.
  std::vector<CellIndex> cells;
  std::vector<std::vector<std::pair<std::size_t, int>>> views_of_cell;
  // Of exact views.
  std::vector<raycast::PanoramaRequest> panoramas;
  std::vector<raycast::PinholeRequest> pinholes;
};

v1::View encode(const ColumnView* view, int heading, bool as_runs) {
  v1::View wire;
  if (view == nullptr) {
    wire.set_no_view(true);
  } else if (as_runs) {
    *wire.mutable_runs() = protocol::to_wire(heading == 0 ? *view : turned(*view, heading));
  } else {
    wire.set_labels(protocol::to_bytes(view->to_labels(heading).pixels()));
  }
  return wire;
}

v1::View encode(const LabelImage& labels, const RangeImage& ranges_m, const Encoding& encoding) {
  v1::View wire;
  if (encoding.runs) {
    *wire.mutable_runs() = protocol::to_wire(ColumnView::from_labels(labels));
  } else {
    wire.set_labels(protocol::to_bytes(labels.pixels()));
  }
  if (encoding.ranges) {
    wire.mutable_ranges_m()->Add(ranges_m.pixels().begin(), ranges_m.pixels().end());
  }
  return wire;
}

Status view_cells(Viewing& viewing, std::size_t begin, std::size_t end) {
  SEMVIEW_TRY(const ViewBatch batch,
              viewing.site->views().views(std::span(viewing.cells).subspan(begin, end - begin)));
  for (std::size_t i = begin; i < end; ++i) {
    for (const auto& [index, heading] : viewing.views_of_cell[i]) {
      viewing.views[index] = encode(batch.views[i - begin].get(), heading, viewing.encoding.runs);
    }
  }
  const std::lock_guard lock(viewing.mutex);
  viewing.origins += batch.origins;
  return {};
}

Status view_panorama(Viewing& viewing, std::size_t index) {
  SEMVIEW_TRY(const raycast::Panorama panorama,
              viewing.site->exact_panorama(viewing.panoramas[index]));
  viewing.views[index] = encode(panorama.labels, panorama.ranges_m, viewing.encoding);
  return {};
}

Status view_pinhole(Viewing& viewing, std::size_t index) {
  SEMVIEW_TRY(const raycast::PinholeView view,
              viewing.site->exact_pinhole(viewing.pinholes[index]));
  viewing.views[index] = encode(view.labels, view.depths_m, viewing.encoding);
  return {};
}

/// Distinct cells in the order of first use, and who wants them.
void merge_cells(Viewing& viewing, const std::vector<CellIndex>& cells, std::vector<int> headings) {
  std::unordered_map<CellIndex, std::size_t> place;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto [entry, added] = place.try_emplace(cells[i], viewing.cells.size());
    if (added) {
      viewing.cells.push_back(cells[i]);
      viewing.views_of_cell.emplace_back();
    }
    viewing.views_of_cell[entry->second].emplace_back(i, headings.empty() ? 0 : headings[i]);
  }
}

Status read_grid(Viewing& viewing, const v1::GetViewsRequest& wire, const service::Limits& limits) {
  std::vector<CellIndex> cells;
  std::vector<int> headings;
  if (wire.has_cells()) {
    SEMVIEW_TRY(cells, protocol::from_wire(wire.cells(), limits.max_views, "cells"));
  } else {
    SEMVIEW_TRY(const std::vector<Pose2> poses,
                protocol::from_wire(wire.poses(), limits.max_views, "poses"));
    for (const Pose2& pose : poses) {
      const auto key = PoseGrid::key(pose);
      if (!key) return protocol::wrong_field("poses", "a pose has no cell");
      cells.push_back(key->cell);
      headings.push_back(key->heading);
    }
  }
  viewing.rows = viewing.site->profile().camera.rows;
  viewing.columns = viewing.site->profile().camera.columns;
  viewing.views.resize(cells.size());
  merge_cells(viewing, cells, std::move(headings));
  return {};
}

Status read_panoramas(Viewing& viewing,
                      const v1::ExactPanoramas& wire,
                      const service::Limits& limits) {
  SEMVIEW_TRY(const std::vector<Pose2> poses,
              protocol::from_wire(wire.poses(), limits.max_views, "panoramas.poses"));
  ViewProfile profile = viewing.site->profile();
  if (wire.has_profile()) {
    SEMVIEW_TRY(profile, protocol::from_wire(wire.profile(), "panoramas.profile"));
  }
  SEMVIEW_TRY(const MapAffine affine, protocol::from_wire(wire.affine(), "panoramas.affine"));
  for (const Pose2& pose : poses) {
    viewing.panoramas.push_back(
        {pose, viewing.site->eye_z_m(profile.eye_height_m), profile.camera, affine});
  }
  viewing.rows = profile.camera.rows;
  viewing.columns = profile.camera.columns;
  viewing.views.resize(poses.size());
  return {};
}

Status read_pinholes(Viewing& viewing,
                     const v1::ExactPinholes& wire,
                     const service::Limits& limits) {
  SEMVIEW_TRY(const std::vector<Pose2> poses,
              protocol::from_wire(wire.poses(), limits.max_views, "pinholes.poses"));
  SEMVIEW_TRY(const PinholeCamera camera, protocol::from_wire(wire, "pinholes"));
  const double eye_height_m =
      wire.eye_height_m() == 0.0 ? viewing.site->profile().eye_height_m : wire.eye_height_m();
  for (const Pose2& pose : poses) {
    viewing.pinholes.push_back({level_camera(pose, viewing.site->eye_z_m(eye_height_m)), camera});
    if (Status status = raycast::validate(viewing.pinholes.back()); !status) {
      Error error = std::move(status).error();
      error.field = fmt::format("pinholes.{}", error.field);
      return fail(std::move(error));
    }
  }
  viewing.rows = camera.rows;
  viewing.columns = camera.columns;
  viewing.views.resize(poses.size());
  return {};
}

std::vector<Chunk> cut_views(const std::shared_ptr<Viewing>& viewing) {
  std::vector<Chunk> chunks;
  for (std::size_t begin = 0; begin < viewing->cells.size(); begin += kCellsPerChunk) {
    const std::size_t end = std::min(begin + kCellsPerChunk, viewing->cells.size());
    chunks.push_back(
        {end - begin, [viewing, begin, end] { return view_cells(*viewing, begin, end); }});
  }
  const std::uint64_t cells = 1 + static_cast<std::uint64_t>(viewing->rows) *
                                      static_cast<std::uint64_t>(viewing->columns) / kPixelsPerCell;
  for (std::size_t i = 0; i < viewing->panoramas.size(); ++i) {
    chunks.push_back({cells, [viewing, i] { return view_panorama(*viewing, i); }});
  }
  for (std::size_t i = 0; i < viewing->pinholes.size(); ++i) {
    chunks.push_back({cells, [viewing, i] { return view_pinhole(*viewing, i); }});
  }
  return chunks;
}

}  // namespace

Result<Plan> plan_get_views(Services& services, const Request& request) {
  SEMVIEW_TRY(const auto wire, protocol::parse<v1::GetViewsRequest>(request.body, "body"));
  const auto viewing = std::make_shared<Viewing>();
  SEMVIEW_TRY(viewing->site, find_site(services, wire.map_id(), wire.fingerprint()));
  SEMVIEW_TRY(viewing->encoding, encoding_of(wire));
  bool exact = false;
  switch (wire.target_case()) {
    case v1::GetViewsRequest::kCells:
    case v1::GetViewsRequest::kPoses:
      SEMVIEW_TRY_STATUS(read_grid(*viewing, wire, services.limits));
      break;
    case v1::GetViewsRequest::kPanoramas:
      SEMVIEW_TRY_STATUS(read_panoramas(*viewing, wire.panoramas(), services.limits));
      exact = true;
      break;
    case v1::GetViewsRequest::kPinholes:
      SEMVIEW_TRY_STATUS(read_pinholes(*viewing, wire.pinholes(), services.limits));
      exact = true;
      break;
    case v1::GetViewsRequest::TARGET_NOT_SET:
      return protocol::wrong_field("target", "expected cells, poses, panoramas or pinholes");
  }
  SEMVIEW_TRY_STATUS(check_pixels(services.limits,
                                  viewing->views.size(),
                                  viewing->rows,
                                  viewing->columns,
                                  viewing->encoding,
                                  exact));
  Plan plan;
  plan.chunks = cut_views(viewing);
  plan.finish = [viewing]() -> Result<std::string> {
    v1::GetViewsReply reply;
    reply.set_rows(static_cast<std::uint32_t>(viewing->rows));
    reply.set_columns(static_cast<std::uint32_t>(viewing->columns));
    reply.mutable_views()->Reserve(static_cast<int>(viewing->views.size()));
    for (v1::View& view : viewing->views) *reply.add_views() = std::move(view);
    *reply.mutable_origins() = protocol::to_wire(viewing->origins);
    return reply.SerializeAsString();
  };
  return plan;
}

}  // namespace semview::server
