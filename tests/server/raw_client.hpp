// SPDX-License-Identifier: Apache-2.0
/// A client without our client library: frames in, frames out.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <zmq.hpp>

#include "semview/protocol/descriptions.hpp"
#include "semview/v1/envelope.pb.h"

namespace semview::test {

struct RawReply {
  v1::ReplyHeader header;
  std::string body;
  std::size_t frames = 0;  ///< as received, a delimiter included
};

class RawClient {
 public:
  explicit RawClient(const std::string& endpoint,
                     zmq::socket_type type = zmq::socket_type::dealer,
                     int unread_replies = 100'000)
      : socket_(context_, type) {
    socket_.set(zmq::sockopt::linger, 0);
    socket_.set(zmq::sockopt::sndhwm, 100'000);
    socket_.set(zmq::sockopt::rcvhwm, unread_replies);
    socket_.connect(endpoint);
  }

  static v1::RequestHeader header(std::string_view method, std::uint64_t id = 1) {
    v1::RequestHeader made;
    made.set_request_id(id);
    made.set_method(std::string(method));
    made.set_protocol_version(protocol::kProtocolVersion);
    made.set_client_name("raw");
    return made;
  }

  void send_frames(const std::vector<std::string>& frames) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      socket_.send(zmq::buffer(frames[i]),
                   i + 1 < frames.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
    }
  }
  void send(const v1::RequestHeader& request, const std::string& body) {
    send_frames({request.SerializeAsString(), body});
  }

  /// From now on `line_was_cut` knows.
  void watch_line() {
    const char* const address = "inproc://line";
    ASSERT_EQ(zmq_socket_monitor(socket_.handle(), address, ZMQ_EVENT_DISCONNECTED), 0);
    line_ = zmq::socket_t(context_, zmq::socket_type::pair);
    line_.connect(address);
  }
  /// Waits for it as long as `patience`.
  bool line_was_cut(std::chrono::milliseconds patience) {
    line_.set(zmq::sockopt::rcvtimeo, static_cast<int>(patience.count()));
    zmq::message_t event;
    return line_.recv(event).has_value();
  }

  std::optional<RawReply> receive(std::chrono::milliseconds patience = std::chrono::seconds(20)) {
    socket_.set(zmq::sockopt::rcvtimeo, static_cast<int>(patience.count()));
    RawReply reply;
    std::vector<std::string> frames;
    zmq::message_t frame;
    do {
      if (!socket_.recv(frame)) return std::nullopt;
      frames.push_back(frame.to_string());
    } while (frame.more());
    reply.frames = frames.size();
    if (frames.size() >= 2) {
      EXPECT_TRUE(reply.header.ParseFromString(frames[frames.size() - 2]));
      reply.body = frames.back();
    }
    return reply;
  }

  RawReply ask(const v1::RequestHeader& request, const std::string& body) {
    send(request, body);
    const auto reply = receive();
    EXPECT_TRUE(reply) << "no reply to " << request.method();
    return reply.value_or(RawReply{});
  }

  /// The result of a method that must succeed.
  template <typename Result, typename Body>
  Result get(std::string_view method, const Body& body) {
    const RawReply reply = ask(header(method), body.SerializeAsString());
    EXPECT_FALSE(reply.header.has_error()) << method << ": " << reply.header.error().message();
    Result result;
    EXPECT_TRUE(result.ParseFromString(reply.body));
    return result;
  }

  /// The error of a method that must fail.
  template <typename Body>
  v1::Error error_of(std::string_view method, const Body& body) {
    const RawReply reply = ask(header(method), body.SerializeAsString());
    EXPECT_TRUE(reply.header.has_error()) << method << " did not fail";
    return reply.header.error();
  }

 private:
  zmq::context_t context_{1};
  zmq::socket_t socket_;
  zmq::socket_t line_;  ///< tells when the connection ends
};

}  // namespace semview::test
