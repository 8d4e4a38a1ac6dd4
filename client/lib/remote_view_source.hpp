// SPDX-License-Identifier: Apache-2.0
/// A ViewSource whose views a server casts and keeps.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "client/lib/connection.hpp"
#include "semview/protocol/descriptions.hpp"
#include "semview/view/view_source.hpp"

namespace semview::client {

/// The views of one map of a server: the same as those of the server's own source.
///
/// @threads As a ViewSource: calls from several threads wait for each other.
class RemoteViewSource final : public ViewSource {
 public:
  /// Asks the server for the map.
  /// @errors kNotFound: no such map; those of `Connection::call`.
  static Result<std::unique_ptr<RemoteViewSource>> open(const ConnectionConfig& config,
                                                        const std::string& map_id);

  const ViewProfile& profile() const override { return map_.profile; }
  const protocol::MapDescription& map() const { return map_; }

  /// @errors those of `Connection::call`; kFailedPrecondition: the server now has another map
  /// under this id.
  Result<ViewBatch> views(std::span<const CellIndex> cells) override;

  /// Bytes of the server's replies so far. @threads not during a call of `views`
  std::uint64_t received_bytes() const { return connection_.received_bytes(); }

 private:
  RemoteViewSource(Connection connection, protocol::MapDescription map);

  std::mutex mutex_;
  Connection connection_;
  const protocol::MapDescription map_;
};

}  // namespace semview::client
