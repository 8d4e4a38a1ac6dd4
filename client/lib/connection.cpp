// SPDX-License-Identifier: Apache-2.0
#include "client/lib/connection.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <zmq.hpp>

#include "semview/protocol/descriptions.hpp"
#include "semview/protocol/envelope.hpp"

namespace semview::client {
namespace {

using Milliseconds = std::chrono::milliseconds;
using SteadyClock = std::chrono::steady_clock;

constexpr int kReconnectInterval_ms = 50, kReconnectIntervalMax_ms = 500;
// A peer that vanished without a word is noticed after this.
constexpr int kHeartbeatInterval_ms = 1000, kHeartbeatTimeout_ms = 3000;
/// A question whether the server is there is given this long, or `timeout`, before the line is
/// renewed.
constexpr Milliseconds kProbeAge{1000};
/// Replies are at most this large: the protocol's own limit of a protobuf message.
constexpr std::int64_t kMaxReplyBytes = std::int64_t{1} << 31U;

struct Reply {
  v1::ReplyHeader header;
  std::string body;
};

tl::unexpected<Error> wrong(std::string_view field, std::string message) {
  return fail(Error{ErrorCode::kInvalidArgument, std::move(message), std::string(field)});
}

}  // namespace

Status validate(const ConnectionConfig& config) {
  const std::size_t colon = config.endpoint.rfind(':');
  if (!config.endpoint.starts_with("tcp://") || colon <= std::strlen("tcp://") ||
      colon + 1 == config.endpoint.size()) {
    return wrong("endpoint",
                 fmt::format("'{}' is not an endpoint; expected tcp://HOST:PORT, for example "
                             "tcp://127.0.0.1:5560",
                             config.endpoint));
  }
  if (config.timeout < Milliseconds{1} || config.timeout > std::chrono::hours{1}) {
    return wrong("timeout",
                 fmt::format("timeout {} ms; expected 1 ms to 1 h", config.timeout.count()));
  }
  if (config.contact < Milliseconds{1}) return wrong("contact", "must be at least 1 ms");
  if (config.attempts < 1) return wrong("attempts", "attempts must be at least 1");
  if (config.client_name.size() > protocol::kMaxClientNameBytes) {
    return wrong("client_name",
                 fmt::format("client name of {} bytes; expected at most {}",
                             config.client_name.size(),
                             protocol::kMaxClientNameBytes));
  }
  return {};
}

/// The sockets behind a Connection. A DEALER for the requests, and a PAIR on which ZeroMQ tells
/// when the line to the server comes and goes: a request that was under way when it went is lost,
/// and known to be lost at once.
class Connection::Line {
 public:
  explicit Line(ConnectionConfig config) : config_(std::move(config)) { connect(); }

  const ConnectionConfig& config() const { return config_; }
  std::uint64_t server_epoch() const { return server_epoch_; }
  std::uint64_t received_bytes() const { return received_bytes_; }

  Result<std::string> call(std::string_view method, std::string_view body, Repeat repeat) {
    const auto deadline = SteadyClock::now() + config_.timeout;
    probe_sent_.reset();
    const int attempts = repeat == Repeat::kSafe ? config_.attempts : 1;
    for (int attempt = 1;; ++attempt) {
      const bool last = attempt >= attempts;
      send(method, body, deadline);
      Result<std::optional<Reply>> reply =
          wait_for_reply(deadline, SteadyClock::now() + config_.contact);
      if (!reply && reply.error().code == ErrorCode::kDeadlineExceeded) return fail(too_late());
      if (!reply) return fail(std::move(reply).error());
      if (!*reply) {
        // The line broke while the request was under way.
        connect();
        if (!last) continue;
        return fail(ErrorCode::kUnavailable,
                    fmt::format("{}: the connection to {} broke", method, config_.endpoint));
      }
      Reply& answer = **reply;
      server_epoch_ = answer.header.server_epoch();
      received_bytes_ += answer.body.size();
      if (!answer.header.has_error()) return std::move(answer.body);
      Error error = protocol::from_wire(answer.header.error());
      const Milliseconds pause{error.retry_after_ms};
      if (last || pause.count() == 0 || SteadyClock::now() + pause >= deadline) {
        return fail(std::move(error));
      }
      rest(pause);
    }
  }

  bool answers(Milliseconds patience) {
    const auto until = SteadyClock::now() + patience;
    if (probe_sent_ && SteadyClock::now() - *probe_sent_ > std::max(config_.timeout, kProbeAge)) {
      // The network may be back while the system still waits to try the old line again.
      connect();
      probe_sent_.reset();
    }
    if (!probe_sent_) {
      probe_sent_ = SteadyClock::now();
      send("Hello", "", *probe_sent_ + config_.timeout);
    }
    const Result<std::optional<Reply>> reply = wait_for_reply(until, until);
    // Nothing yet: the question stays under way.
    if (!reply && reply.error().code == ErrorCode::kDeadlineExceeded) return false;
    probe_sent_.reset();
    if (reply && *reply) {
      server_epoch_ = (*reply)->header.server_epoch();
      return true;
    }
    connect();
    return false;
  }

 private:
  /// A new socket: nothing that was sent on the old one can be answered here.
  void connect() {
    monitor_ = zmq::socket_t(context_, zmq::socket_type::pair);
    socket_ = zmq::socket_t(context_, zmq::socket_type::dealer);
    socket_.set(zmq::sockopt::linger, 0);
    socket_.set(zmq::sockopt::reconnect_ivl, kReconnectInterval_ms);
    socket_.set(zmq::sockopt::reconnect_ivl_max, kReconnectIntervalMax_ms);
    socket_.set(zmq::sockopt::heartbeat_ivl, kHeartbeatInterval_ms);
    socket_.set(zmq::sockopt::heartbeat_timeout, kHeartbeatTimeout_ms);
    socket_.set(zmq::sockopt::maxmsgsize, kMaxReplyBytes);
    const std::string address = fmt::format("inproc://monitor-{}", ++monitors_);
    if (zmq_socket_monitor(socket_.handle(),
                           address.c_str(),
                           ZMQ_EVENT_HANDSHAKE_SUCCEEDED | ZMQ_EVENT_DISCONNECTED) != 0) {
      throw zmq::error_t();
    }
    monitor_.connect(address);
    connected_ = false;
    socket_.connect(config_.endpoint);
  }

  void send(std::string_view method, std::string_view body, SteadyClock::time_point deadline) {
    const auto left =
        std::chrono::duration_cast<Milliseconds>(deadline - SteadyClock::now()).count();
    v1::RequestHeader header;
    header.set_request_id(++request_id_);
    header.set_method(std::string(method));
    header.set_protocol_version(protocol::kProtocolVersion);
    header.set_deadline_ms(static_cast<std::uint32_t>(std::max<std::int64_t>(left, 1)));
    header.set_client_name(config_.client_name);
    // News from before this request says nothing about it.
    while (line_broke()) {
    }
    // Not connected yet: ZeroMQ keeps the request until it is.
    socket_.send(zmq::buffer(header.SerializeAsString()),
                 zmq::send_flags::sndmore | zmq::send_flags::dontwait);
    socket_.send(zmq::buffer(body), zmq::send_flags::dontwait);
  }

  /// The reply to the last request; `nullopt`: the line broke before it came.
  /// @errors kDeadlineExceeded: neither in time, or no line by then; kDataLoss: unreadable.
  Result<std::optional<Reply>> wait_for_reply(SteadyClock::time_point deadline,
                                              SteadyClock::time_point contact_deadline) {
    for (;;) {
      const auto until = connected_ ? deadline : std::min(deadline, contact_deadline);
      const auto left = until - SteadyClock::now();
      if (left <= SteadyClock::duration::zero()) return fail(ErrorCode::kDeadlineExceeded, "");
      std::array<zmq::pollitem_t, 2> items = {zmq::pollitem_t{socket_.handle(), 0, ZMQ_POLLIN, 0},
                                              zmq::pollitem_t{monitor_.handle(), 0, ZMQ_POLLIN, 0}};
      poll(items.data(), items.size(), std::chrono::ceil<Milliseconds>(left));
      SEMVIEW_TRY(std::optional<Reply> reply, receive());
      if (reply) return reply;
      if (line_broke()) return std::optional<Reply>();
    }
  }

  Error too_late() {
    const bool was_connected = connected_;
    // A late reply must not be taken for that of the next request.
    connect();
    const std::string& server = config_.endpoint;
    if (was_connected) {
      return {ErrorCode::kDeadlineExceeded,
              fmt::format("{} did not answer within {} ms", server, config_.timeout.count())};
    }
    const auto waited = std::min(config_.timeout, config_.contact);
    return {ErrorCode::kUnavailable,
            fmt::format("no server at {} within {} ms", server, waited.count()),
            "",
            "is semview-server running there?"};
  }

  /// The reply to the last request, if it has come; others are thrown away.
  Result<std::optional<Reply>> receive() {
    for (;;) {
      zmq::message_t frame;
      if (!socket_.recv(frame, zmq::recv_flags::dontwait)) return std::optional<Reply>();
      std::string header = frame.to_string();
      std::string body;
      std::size_t frames = 1;
      while (frame.more() && socket_.recv(frame)) {
        if (++frames == 2) body = frame.to_string();
      }
      SEMVIEW_TRY(v1::ReplyHeader parsed, protocol::parse<v1::ReplyHeader>(header, "reply header"));
      if (frames != 2) {
        return fail(ErrorCode::kDataLoss, fmt::format("a reply of {} frames", frames));
      }
      if (parsed.request_id() == request_id_) {
        return std::optional(Reply{std::move(parsed), std::move(body)});
      }
    }
  }

  /// Reads one piece of news of the line; true if it is that it broke.
  bool line_broke() {
    zmq::message_t event;
    while (monitor_.recv(event, zmq::recv_flags::dontwait)) {
      std::uint16_t kind = 0;
      if (event.size() >= sizeof kind) std::memcpy(&kind, event.data(), sizeof kind);
      while (event.more() && monitor_.recv(event)) {
      }
      connected_ = kind == ZMQ_EVENT_HANDSHAKE_SUCCEEDED;
      if (!connected_) return true;
    }
    return false;
  }

  static void rest(Milliseconds time) { poll(nullptr, 0, time); }

  static void poll(zmq::pollitem_t* items, std::size_t count, Milliseconds time) {
    try {
      zmq::poll(items, count, time);
    } catch (const zmq::error_t& error) {
      // A signal for the program that we are part of.
      if (error.num() != EINTR) throw;
    }
  }

  const ConnectionConfig config_;
  zmq::context_t context_{1};
  zmq::socket_t monitor_;
  zmq::socket_t socket_;
  int monitors_ = 0;
  bool connected_ = false;
  std::uint64_t request_id_ = 0;
  std::optional<SteadyClock::time_point> probe_sent_;  ///< the last request asks only for a sign
  std::uint64_t server_epoch_ = 0;
  std::uint64_t received_bytes_ = 0;
};

Result<Connection> Connection::open(const ConnectionConfig& config) {
  SEMVIEW_TRY_STATUS(validate(config));
  try {
    return Connection(std::make_unique<Line>(config));
  } catch (const zmq::error_t& error) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("{}: {}", config.endpoint, error.what()),
                      "endpoint"});
  }
}

Connection::Connection(std::unique_ptr<Line> line) : line_(std::move(line)) {}
Connection::~Connection() = default;
Connection::Connection(Connection&&) noexcept = default;
Connection& Connection::operator=(Connection&&) noexcept = default;

const ConnectionConfig& Connection::config() const { return line_->config(); }
std::uint64_t Connection::server_epoch() const { return line_->server_epoch(); }
std::uint64_t Connection::received_bytes() const { return line_->received_bytes(); }

Result<std::string> Connection::call(std::string_view method,
                                     std::string_view body,
                                     Repeat repeat) {
  try {
    return line_->call(method, body, repeat);
  } catch (const zmq::error_t& error) {
    return fail(ErrorCode::kUnavailable, fmt::format("{}: {}", config().endpoint, error.what()));
  }
}

bool Connection::answers(std::chrono::milliseconds patience) {
  try {
    return line_->answers(patience);
  } catch (const zmq::error_t&) {
    return false;
  }
}

}  // namespace semview::client
