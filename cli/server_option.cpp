// SPDX-License-Identifier: Apache-2.0
#include "server_option.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace semview::cli {

void add_server_option(CLI::App& verb, std::string& server, const std::string& does) {
  verb.add_option(
          "--server", server, fmt::format("Let this server {}; MAP is the map's id there", does))
      ->type_name("tcp://HOST:PORT");
}

Result<client::ConnectionConfig> connection_to(const std::string& server,
                                               const std::string& verb,
                                               std::chrono::milliseconds timeout) {
  client::ConnectionConfig config;
  config.endpoint = server;
  config.timeout = timeout;
  config.client_name = "semview " + verb;
  if (const Status valid = validate(config); !valid) {
    Error error = valid.error();
    error.field = "--server";
    return fail(std::move(error));
  }
  return config;
}

}  // namespace semview::cli
