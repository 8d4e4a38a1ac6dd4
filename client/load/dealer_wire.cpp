// SPDX-License-Identifier: Apache-2.0
#include "client/load/dealer_wire.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <deque>
#include <utility>
#include <vector>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/resource.h>
#include <zmq.hpp>

#include "semview/protocol/descriptions.hpp"
#include "semview/protocol/envelope.hpp"

namespace semview::client {
namespace {

/// Descriptors that a line takes in this process, the server's end included if it is here.
constexpr std::size_t kDescriptorsOfLine = 4;
constexpr std::size_t kOtherDescriptors = 100;
/// Requests that a line holds for a server that does not read; more are lost, and time out.
constexpr int kMostUnsent = 16;

/// The addresses of this machine, in digits.
std::vector<std::string> own_addresses() {
  std::vector<std::string> addresses;
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) return addresses;
  for (const ifaddrs* entry = all; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    sockaddr_in address{};
    std::memcpy(&address, entry->ifa_addr, sizeof address);
    std::array<char, INET_ADDRSTRLEN> digits{};
    if (::inet_ntop(AF_INET, &address.sin_addr, digits.data(), digits.size()) != nullptr) {
      addresses.emplace_back(digits.data());
    }
  }
  ::freeifaddrs(all);
  return addresses;
}

/// In digits: 127.0.0.0/8, ::1 in brackets, or an address of this machine's own.
bool is_own_address(const std::string& host) {
  in_addr v4{};
  if (::inet_pton(AF_INET, host.c_str(), &v4) == 1) {
    constexpr std::uint32_t kLoopbackNet = 127;
    return ntohl(v4.s_addr) >> 24U == kLoopbackNet || std::ranges::count(own_addresses(), host) > 0;
  }
  if (!host.starts_with('[') || !host.ends_with(']')) return false;
  in6_addr v6{};
  return ::inet_pton(AF_INET6, host.substr(1, host.size() - 2).c_str(), &v6) == 1 &&
         IN6_IS_ADDR_LOOPBACK(&v6);
}

/// Raises the limit on open files as far as it goes without asking anybody.
std::size_t allowed_descriptors() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return 0;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
  ::getrlimit(RLIMIT_NOFILE, &limit);
  return static_cast<std::size_t>(limit.rlim_cur);
}

}  // namespace

Status check_is_this_machine(const std::string& endpoint) {
  constexpr std::string_view kScheme = "tcp://";
  const std::size_t colon = endpoint.rfind(':');
  if (endpoint.starts_with(kScheme) && colon != std::string::npos && colon > kScheme.size()) {
    const std::string host = endpoint.substr(kScheme.size(), colon - kScheme.size());
    // A name that only looks like an address (127.0.0.1.example.org) is another machine's.
    if (host == "localhost" || is_own_address(host)) return {};
  }
  return fail(Error{ErrorCode::kInvalidArgument,
                    fmt::format("--server {}: a load is for a server on this machine, for example "
                                "tcp://127.0.0.1:5560",
                                endpoint),
                    "--server"});
}

class DealerWire::Lines {
 public:
  Lines(const std::string& endpoint, std::size_t robots) {
    context_.set(zmq::ctxopt::max_sockets, static_cast<int>(robots) + 1);
    for (std::size_t i = 0; i < robots; ++i) {
      zmq::socket_t& line = lines_.emplace_back(context_, zmq::socket_type::dealer);
      line.set(zmq::sockopt::linger, 0);
      line.set(zmq::sockopt::sndhwm, kMostUnsent);
      line.set(zmq::sockopt::rcvhwm, 0);
      line.connect(endpoint);
      files_.push_back({line.get(zmq::sockopt::fd), POLLIN, 0});
    }
  }

  void send(std::size_t robot,
            std::uint64_t request_id,
            std::string_view method,
            std::string_view body,
            std::chrono::milliseconds budget) {
    v1::RequestHeader header;
    header.set_request_id(request_id);
    header.set_method(std::string(method));
    header.set_protocol_version(protocol::kProtocolVersion);
    header.set_deadline_ms(static_cast<std::uint32_t>(budget.count()));
    header.set_client_name("load");
    constexpr auto kNow = zmq::send_flags::dontwait;
    const std::string head = header.SerializeAsString();
    // Whether the line takes a message is decided at its first part.
    if (lines_[robot].send(zmq::buffer(head), zmq::send_flags::sndmore | kNow)) {
      lines_[robot].send(zmq::buffer(body), kNow);
    }
    // Sending may take the sign of a reply from the socket's file: it is looked at in any case.
    drain(robot);
  }

  std::optional<LoadReply> receive(TimePoint until) {
    for (;;) {
      if (!replies_.empty()) {
        LoadReply reply = std::move(replies_.front());
        replies_.pop_front();
        return reply;
      }
      const auto left = until - std::chrono::steady_clock::now();
      if (left <= Duration::zero()) return std::nullopt;
      const auto seconds = std::chrono::floor<std::chrono::seconds>(left);
      const std::chrono::nanoseconds rest = left - seconds;
      const timespec time{static_cast<time_t>(seconds.count()), static_cast<long>(rest.count())};
      if (::ppoll(files_.data(), files_.size(), &time, nullptr) <= 0) continue;
      for (std::size_t i = 0; i < files_.size(); ++i) {
        if ((files_[i].revents & POLLIN) != 0) drain(i);
      }
    }
  }

 private:
  /// All that has come on a line; a socket's file tells of news only once.
  void drain(std::size_t robot) {
    zmq::message_t header;
    while (lines_[robot].recv(header, zmq::recv_flags::dontwait)) {
      zmq::message_t body;
      bool more = header.more();
      while (more && lines_[robot].recv(body)) more = body.more();
      const auto parsed = protocol::parse<v1::ReplyHeader>(header.to_string_view(), "reply header");
      if (!parsed) continue;
      if (parsed->has_error()) {
        replies_.push_back({parsed->request_id(), fail(protocol::from_wire(parsed->error()))});
      } else {
        replies_.push_back({parsed->request_id(), body.to_string()});
      }
    }
  }

  zmq::context_t context_{1};
  std::vector<zmq::socket_t> lines_;
  std::vector<pollfd> files_;  ///< one a line
  std::deque<LoadReply> replies_;
};

Result<std::unique_ptr<DealerWire>> DealerWire::open(const std::string& endpoint,
                                                     std::size_t robots) {
  SEMVIEW_TRY_STATUS(check_is_this_machine(endpoint));
  const std::size_t wanted = robots * kDescriptorsOfLine + kOtherDescriptors;
  if (const std::size_t allowed = allowed_descriptors(); allowed < wanted) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("--robots {}: they need {} open files, this process may have {}",
                                  robots,
                                  wanted,
                                  allowed),
                      "--robots",
                      "raise it with ulimit -n"});
  }
  try {
    return std::unique_ptr<DealerWire>(new DealerWire(std::make_unique<Lines>(endpoint, robots)));
  } catch (const zmq::error_t& error) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("--server {}: {}", endpoint, error.what()),
                      "--server"});
  }
}

DealerWire::DealerWire(std::unique_ptr<Lines> lines) : lines_(std::move(lines)) {}
DealerWire::~DealerWire() = default;

void DealerWire::send(std::size_t robot,
                      std::uint64_t request_id,
                      std::string_view method,
                      std::string_view body,
                      std::chrono::milliseconds budget) {
  lines_->send(robot, request_id, method, body, budget);
}

std::optional<LoadReply> DealerWire::receive(TimePoint until) { return lines_->receive(until); }

}  // namespace semview::client
