// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <mutex>
#include <span>
#include <utility>

#include "methods.hpp"
#include "semview/protocol/envelope.hpp"
#include "semview/protocol/packed_runs.hpp"
#include "semview/protocol/view_wire.hpp"
#include "view_request.hpp"

namespace semview::server {
namespace {

/// Pixels of a default panorama: what one cell of estimated work stands for.
constexpr std::uint64_t kPixelsPerCell = 360 * 90;

/// A GetViews under way; each chunk fills its own part of `views`.
struct Viewing {
  ViewRequest request;
  std::vector<v1::View> views;
  std::mutex mutex;  ///< guards origins
  ViewOrigins origins;
};

/// The same panorama turned to a heading of the grid.
ColumnView turned(const ColumnView& view, int heading) {
  std::vector<std::uint32_t> columns(static_cast<std::size_t>(view.columns()));
  for (int c = 0; c < view.columns(); ++c) {
    columns[static_cast<std::size_t>(c)] =
        static_cast<std::uint32_t>(PoseGrid::source_column(c, heading, view.columns()));
  }
  return view.arranged(columns);
}

void encode_runs(const ColumnView& view, bool packed, v1::RunPanorama* wire) {
  if (packed) {
    wire->set_packed(protocol::pack_runs(view));
    wire->set_planes(protocol::pack_planes(view));
  } else {
    *wire = protocol::to_wire(view);
  }
}

v1::View encode(const ColumnView& view,
                const PanoramaCamera& camera,
                int heading,
                const ViewEncoding& encoding) {
  v1::View wire;
  if (encoding.runs && view.has_ranges() && !encoding.ranges) {
    const ColumnView labels = view.without_ranges();
    encode_runs(
        heading == 0 ? labels : turned(labels, heading), encoding.packed, wire.mutable_runs());
  } else if (encoding.runs) {
    encode_runs(heading == 0 ? view : turned(view, heading), encoding.packed, wire.mutable_runs());
  } else {
    wire.set_labels(protocol::to_bytes(view.to_labels(heading).pixels()));
    if (encoding.ranges) {
      const RangeImage ranges_m = view.to_ranges(camera, heading);
      wire.mutable_ranges_m()->Add(ranges_m.pixels().begin(), ranges_m.pixels().end());
    }
  }
  return wire;
}

v1::View encode(const LabelImage& labels,
                const RangeImage& ranges_m,
                const ViewEncoding& encoding) {
  v1::View wire;
  const auto runs = [&labels] { return ColumnView::from_labels(labels); };
  if (encoding.packed) {
    wire.mutable_runs()->set_packed(protocol::pack_runs(runs()));
  } else if (encoding.runs) {
    *wire.mutable_runs() = protocol::to_wire(runs());
  } else {
    wire.set_labels(protocol::to_bytes(labels.pixels()));
  }
  if (encoding.ranges) {
    wire.mutable_ranges_m()->Add(ranges_m.pixels().begin(), ranges_m.pixels().end());
  }
  return wire;
}

Status view_cells(Viewing& viewing, std::size_t begin, std::size_t end) {
  const ViewRequest& request = viewing.request;
  SEMVIEW_TRY(const ViewBatch batch,
              request.site->views().views(std::span(request.cells).subspan(begin, end - begin)));
  for (std::size_t i = begin; i < end; ++i) {
    for (const auto& [view, heading] : request.uses[i]) {
      if (const SharedView& found = batch.views[i - begin]) {
        viewing.views[view] =
            encode(*found, request.site->profile().camera, heading, request.encoding);
      } else {
        viewing.views[view].set_no_view(true);
      }
    }
  }
  const std::lock_guard lock(viewing.mutex);
  viewing.origins += batch.origins;
  return {};
}

Status view_panorama(Viewing& viewing, std::size_t index) {
  const ViewRequest& request = viewing.request;
  SEMVIEW_TRY(const raycast::Panorama panorama,
              request.site->exact_panorama(request.panoramas[index]));
  viewing.views[index] = encode(panorama.labels, panorama.ranges_m, request.encoding);
  return {};
}

Status view_pinhole(Viewing& viewing, std::size_t index) {
  const ViewRequest& request = viewing.request;
  SEMVIEW_TRY(const raycast::PinholeView view,
              request.site->exact_pinhole(request.pinholes[index]));
  viewing.views[index] = encode(view.labels, view.depths_m, request.encoding);
  return {};
}

std::vector<Chunk> cut_views(const std::shared_ptr<Viewing>& viewing) {
  const ViewRequest& request = viewing->request;
  std::vector<Chunk> chunks;
  for (std::size_t begin = 0; begin < request.cells.size(); begin += kCellsPerChunk) {
    const std::size_t end = std::min(begin + kCellsPerChunk, request.cells.size());
    chunks.push_back(
        {end - begin, [viewing, begin, end] { return view_cells(*viewing, begin, end); }});
  }
  const std::uint64_t cells = 1 + static_cast<std::uint64_t>(request.rows) *
                                      static_cast<std::uint64_t>(request.columns) / kPixelsPerCell;
  for (std::size_t i = 0; i < request.panoramas.size(); ++i) {
    chunks.push_back({cells, [viewing, i] { return view_panorama(*viewing, i); }});
  }
  for (std::size_t i = 0; i < request.pinholes.size(); ++i) {
    chunks.push_back({cells, [viewing, i] { return view_pinhole(*viewing, i); }});
  }
  return chunks;
}

}  // namespace

Result<Plan> plan_get_views(Services& services, const Request& request) {
  SEMVIEW_TRY(const auto wire, protocol::parse<v1::GetViewsRequest>(request.body, "body"));
  SEMVIEW_TRY(std::shared_ptr<service::Site> site,
              find_site(services, wire.map_id(), wire.fingerprint()));
  const auto viewing = std::make_shared<Viewing>();
  SEMVIEW_TRY(viewing->request, read_view_request(std::move(site), wire, services.limits));
  viewing->views.resize(viewing->request.views);
  Plan plan;
  plan.chunks = cut_views(viewing);
  plan.finish = [viewing]() -> Result<std::string> {
    v1::GetViewsReply reply;
    reply.set_rows(static_cast<std::uint32_t>(viewing->request.rows));
    reply.set_columns(static_cast<std::uint32_t>(viewing->request.columns));
    reply.mutable_views()->Reserve(static_cast<int>(viewing->views.size()));
    for (v1::View& view : viewing->views) *reply.add_views() = std::move(view);
    *reply.mutable_origins() = protocol::to_wire(viewing->origins);
    return reply.SerializeAsString();
  };
  return plan;
}

}  // namespace semview::server
