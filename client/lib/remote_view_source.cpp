// SPDX-License-Identifier: Apache-2.0
#include "client/lib/remote_view_source.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "client/lib/remote_maps.hpp"
#include "client/lib/typed_call.hpp"
#include "semview/protocol/map_wire.hpp"
#include "semview/protocol/view_wire.hpp"

namespace semview::client {
namespace {

/// Views of one request: 5 MB of runs, far below any server's limits.
constexpr std::size_t kViewsPerRequest = 1000;

}  // namespace

Result<std::unique_ptr<RemoteViewSource>> RemoteViewSource::open(const ConnectionConfig& config,
                                                                 const std::string& map_id) {
  SEMVIEW_TRY(Connection connection, Connection::open(config));
  SEMVIEW_TRY(protocol::MapDescription map, get_map(connection, map_id));
  return std::unique_ptr<RemoteViewSource>(
      new RemoteViewSource(std::move(connection), std::move(map)));
}

RemoteViewSource::RemoteViewSource(Connection connection, protocol::MapDescription map)
    : connection_(std::move(connection)), map_(std::move(map)) {}

Result<ViewBatch> RemoteViewSource::views(std::span<const CellIndex> cells) {
  const std::lock_guard lock(mutex_);
  ViewBatch all;
  all.views.reserve(cells.size());
  while (!cells.empty()) {
    const auto some = cells.first(std::min(cells.size(), kViewsPerRequest));
    cells = cells.subspan(some.size());
    v1::GetViewsRequest request;
    request.set_map_id(map_.summary.id);
    request.set_fingerprint(protocol::to_wire(map_.summary.fingerprint));
    protocol::to_wire(some, request.mutable_cells());
    request.set_packed_runs(true);
    request.set_with_ranges(profile().ranges);
    SEMVIEW_TRY(const auto reply, typed_call<v1::GetViewsReply>(connection_, "GetViews", request));
    SEMVIEW_TRY(ViewBatch batch, protocol::from_wire(reply, some.size()));
    std::move(batch.views.begin(), batch.views.end(), std::back_inserter(all.views));
    all.origins += batch.origins;
  }
  return all;
}

}  // namespace semview::client
