// SPDX-License-Identifier: Apache-2.0
/// `--server`: the server that answers in the place of this process.
#pragma once

#include <chrono>
#include <string>

#include "client/lib/connection.hpp"
#include "semview/core/result.hpp"

namespace CLI {
class App;
}

namespace semview::cli {

/// `server` stays empty unless the option is given. `does` says what the server is asked for.
void add_server_option(CLI::App& verb, std::string& server, const std::string& does);

/// How `verb` reaches `server`.
/// @errors kInvalidArgument, field `--server`.
Result<client::ConnectionConfig> connection_to(const std::string& server,
                                               const std::string& verb,
                                               std::chrono::milliseconds timeout);

}  // namespace semview::cli
