// SPDX-License-Identifier: Apache-2.0
/// The lines of simulated robots to a server on this machine.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>

#include "client/load/open_loop.hpp"

namespace semview::client {

/// A load is for one's own server: no other machine is loaded by accident.
/// @errors kInvalidArgument, field `--server`: not `tcp://address:port` with an address of this
/// machine.
Status check_is_this_machine(const std::string& endpoint);

/// One DEALER socket a robot. Times are kept to some microseconds, which zmq_poll's milliseconds
/// would not do.
/// @threads for one thread
class DealerWire final : public LoadWire {
 public:
  /// @errors those of `check_is_this_machine`; kInvalidArgument, field `--robots`: more than this
  /// process may have sockets.
  static Result<std::unique_ptr<DealerWire>> open(const std::string& endpoint, std::size_t robots);
  ~DealerWire() override;

  void send(std::size_t robot,
            std::uint64_t request_id,
            std::string_view method,
            std::string_view body,
            std::chrono::milliseconds budget) override;
  std::optional<LoadReply> receive(TimePoint until) override;

 private:
  class Lines;
  explicit DealerWire(std::unique_ptr<Lines> lines);
  std::unique_ptr<Lines> lines_;
};

}  // namespace semview::client
