// SPDX-License-Identifier: Apache-2.0
#include "sockets.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <vector>

#include <fmt/format.h>
#include <sys/eventfd.h>
#include <unistd.h>
#include <zmq.hpp>

namespace semview::server {
namespace {

/// A message above the limit but below this is read, so that its sender gets a typed error; beyond
/// it the connection is cut.
constexpr std::size_t kCutFactor = 2;
/// Messages that the socket itself holds for one client; more wait with us, where they are counted.
constexpr int kMessagesInSocket = 8;
/// How long replies that are still on their way are given when the server ends.
constexpr int kLinger_ms = 1000;

std::string last_endpoint(const zmq::socket_t& socket) {
  return socket.get(zmq::sockopt::last_endpoint);
}

std::uint16_t port_of(std::string_view endpoint) {
  const std::string_view digits = endpoint.substr(endpoint.rfind(':') + 1);
  std::uint16_t port = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), port);
  return port;
}

std::string hint_of(int zmq_error) {
  if (zmq_error == EADDRINUSE) return "another server may be running there";
  if (zmq_error == EADDRNOTAVAIL || zmq_error == ENODEV) {
    return "ADDRESS must be one of this machine's, in digits: 127.0.0.1 lets only this machine in; "
           "0.0.0.0 lets in every machine that reaches it, and there is no authentication yet";
  }
  return "";
}

Status check_endpoint(const std::string& endpoint) {
  constexpr std::string_view kScheme = "tcp://";
  const std::size_t colon = endpoint.rfind(':');
  const std::string port = colon == std::string::npos ? "" : endpoint.substr(colon + 1);
  const bool number = !port.empty() && port.size() <= 5 &&
                      port.find_first_not_of("0123456789") == std::string::npos &&
                      std::stoi(port) <= 65535;
  if (endpoint.starts_with(kScheme) && colon > kScheme.size() && (number || port == "*")) return {};
  return fail(Error{ErrorCode::kInvalidArgument,
                    fmt::format("--bind {}: expected tcp://ADDRESS:PORT, for example "
                                "tcp://127.0.0.1:5560 (* as port takes any free one)",
                                endpoint),
                    "--bind"});
}

/// ZeroMQ binds to addresses and interfaces only; of names it knows none.
std::string without_name(const std::string& endpoint) {
  constexpr std::string_view kNamed = "tcp://localhost:";
  if (!endpoint.starts_with(kNamed)) return endpoint;
  return "tcp://127.0.0.1:" + endpoint.substr(kNamed.size());
}

}  // namespace

struct Sockets::Parts {
  zmq::context_t context{1};
  zmq::socket_t router{context, zmq::socket_type::router};
  zmq::socket_t events;
  std::string endpoint;
  std::string events_endpoint;
  int bell = -1;

  ~Parts() {
    if (bell >= 0) ::close(bell);
  }

  void bind_requests(const std::string& address, const SocketConfig& config) {
    const auto largest = static_cast<std::int64_t>(config.max_message_bytes * kCutFactor);
    router.set(zmq::sockopt::maxmsgsize, largest);
    router.set(zmq::sockopt::linger, kLinger_ms);
    router.set(zmq::sockopt::sndhwm, kMessagesInSocket);
    router.set(zmq::sockopt::rcvhwm, kMessagesInSocket);
    // Without it replies to clients that are gone or do not read vanish uncounted.
    router.set(zmq::sockopt::router_mandatory, 1);
    router.bind(address);
    endpoint = last_endpoint(router);
  }

  void bind_events(const std::string& address) {
    events = zmq::socket_t(context, zmq::socket_type::pub);
    events.set(zmq::sockopt::linger, 0);
    events.set(zmq::sockopt::maxmsgsize, std::int64_t{4096});
    events.bind(address);
    events_endpoint = last_endpoint(events);
  }
};

Result<std::unique_ptr<Sockets>> Sockets::bind(const SocketConfig& config) {
  SEMVIEW_TRY_STATUS(check_endpoint(config.bind));
  const std::string address = without_name(config.bind);
  const std::string events_port =
      config.events_port == 0 ? "*" : std::to_string(config.events_port);
  std::string option = fmt::format("--bind {}", config.bind);
  try {
    auto parts = std::make_unique<Parts>();
    parts->bell = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    if (parts->bell < 0) return fail(ErrorCode::kResourceExhausted, "no file descriptor left");
    parts->bind_requests(address, config);
    if (config.events) {
      option = fmt::format("--events-port {}", events_port);
      parts->bind_events(fmt::format("{}:{}", address.substr(0, address.rfind(':')), events_port));
    }
    return std::unique_ptr<Sockets>(new Sockets(std::move(parts)));
  } catch (const zmq::error_t& error) {
    return fail(Error{ErrorCode::kUnavailable,
                      fmt::format("{}: {}", option, error.what()),
                      "",
                      hint_of(error.num())});
  }
}

Sockets::Sockets(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Sockets::~Sockets() = default;

const std::string& Sockets::endpoint() const { return parts_->endpoint; }
const std::string& Sockets::events_endpoint() const { return parts_->events_endpoint; }
std::uint16_t Sockets::events_port() const {
  return parts_->events_endpoint.empty() ? std::uint16_t{0} : port_of(parts_->events_endpoint);
}

void Sockets::wait(std::chrono::milliseconds time) {
  std::array<zmq::pollitem_t, 2> items = {
      zmq::pollitem_t{parts_->router.handle(), 0, ZMQ_POLLIN, 0},
      zmq::pollitem_t{nullptr, parts_->bell, ZMQ_POLLIN, 0}};
  try {
    zmq::poll(items.data(), items.size(), time);
  } catch (const zmq::error_t& error) {
    // A signal: its flag is looked at by whoever called.
    if (error.num() != EINTR) throw;
  }
  std::uint64_t rings = 0;
  [[maybe_unused]] const ssize_t got = ::read(parts_->bell, &rings, sizeof rings);
}

std::optional<Incoming> Sockets::receive() {
  zmq::message_t frame;
  if (!parts_->router.recv(frame, zmq::recv_flags::dontwait)) return std::nullopt;
  Incoming incoming;
  incoming.client = frame.to_string();
  bool first = true;
  // Frames beyond the second are dropped one by one, so that a message of very many holds no
  // memory.
  while (frame.more()) {
    // The rest of a message has arrived with its first frame: this does not wait.
    if (!parts_->router.recv(frame)) break;
    if (first && frame.empty() && frame.more()) {
      incoming.delimiter = true;
    } else {
      ++incoming.frames;
      if (incoming.frames == 1) incoming.header = frame.to_string();
      if (incoming.frames == 2) incoming.body = frame.to_string();
    }
    first = false;
  }
  incoming.well_formed = incoming.frames == 2;
  return incoming;
}

Sent Sockets::send(const Outgoing& reply) {
  const auto part = [this](const std::string& bytes, bool more) {
    const auto flags =
        zmq::send_flags::dontwait | (more ? zmq::send_flags::sndmore : zmq::send_flags::none);
    return parts_->router.send(zmq::buffer(bytes), flags).has_value();
  };
  try {
    // Whether the client can take it is decided at the first part.
    if (!part(reply.client, true)) return Sent::kFull;
    if (reply.delimiter) part({}, true);
    part(reply.header, true);
    part(reply.body, false);
    return Sent::kSent;
  } catch (const zmq::error_t& error) {
    if (error.num() == EHOSTUNREACH) return Sent::kGone;
    throw;
  }
}

void Sockets::publish(std::string_view topic, std::string_view event) {
  if (parts_->events_endpoint.empty()) return;
  parts_->events.send(zmq::buffer(topic), zmq::send_flags::sndmore | zmq::send_flags::dontwait);
  parts_->events.send(zmq::buffer(event), zmq::send_flags::dontwait);
}

void Sockets::ring() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t put = ::write(parts_->bell, &one, sizeof one);
}

}  // namespace semview::server
