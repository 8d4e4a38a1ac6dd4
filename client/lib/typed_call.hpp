// SPDX-License-Identifier: Apache-2.0
/// `Connection::call` with messages in place of bytes; for .cpp files, since messages are heavy.
#pragma once

#include <string_view>

#include "client/lib/connection.hpp"
#include "semview/protocol/envelope.hpp"

namespace semview::client {

/// @errors those of `Connection::call`; kDataLoss: the reply is not a `Reply`.
template <typename Reply, typename Request>
Result<Reply> typed_call(Connection& connection,
                         std::string_view method,
                         const Request& request,
                         Repeat repeat = Repeat::kSafe) {
  SEMVIEW_TRY(const std::string body, connection.call(method, request.SerializeAsString(), repeat));
  return protocol::parse<Reply>(body, "reply");
}

}  // namespace semview::client
